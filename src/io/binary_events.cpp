#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <utility>
#include <vector>

#include "io/address_events.hpp"
#include "io/event_formats.hpp"
#include "io/event_time.hpp"

namespace corpuscle {
namespace {

namespace aer = address_events;

/// "sa1#17" is sa1, number 17; a name without a number stands alone.
aer::NameRun run_of(const std::string& name, std::uint32_t address) {
    const auto sign = name.rfind('#');
    std::uint32_t number = 0;
    if (sign == name.npos || name.size() == sign + 1 || name[sign + 1] == '0') return {address, 1, 0, 1, name};
    const auto [end, status] = std::from_chars(name.data() + sign + 1, name.data() + name.size(), number);
    if (status != std::errc{} || end != name.data() + name.size()) return {address, 1, 0, 1, name};
    return {address, 1, number, 1, name.substr(0, sign)};
}

/// Whether the unit goes on where the run ends; if so, it is part of it then.
bool take_in(aer::NameRun& run, const aer::NameRun& next) {
    if (run.number == 0 || next.number != run.number + run.count || next.name != run.name || next.address <= run.address) return false;
    if (run.count == 1) run.stride = next.address - run.address;
    if (next.address != run.address + static_cast<std::uint64_t>(run.stride) * run.count) return false;
    ++run.count;
    return true;
}

std::vector<aer::NameRun> runs_of(const EventUnits& units) {
    std::vector<aer::NameRun> runs;
    for (std::size_t u = 0; u < units.names.size(); ++u) {
        auto next = run_of(units.names[u], units.addresses[u]);
        if (runs.empty() || !take_in(runs.back(), next)) runs.push_back(std::move(next));
    }
    return runs;
}

/// Which channel the units at some addresses stand on, where the units' names do not tell: in the order of the addresses. Channels without
/// names of their own (ch1, ch2 ...) are as good as their numbers.
std::vector<aer::NameRun> channel_runs_of(const EventUnits& units) {
    std::vector<std::pair<std::uint32_t, const std::string*>> on;
    bool any_named = false;
    for (std::size_t u = 0; u < units.afferents.size() && u < units.channels.size(); ++u) {
        if (units.afferents[u] == units.names[u]) return {};
        on.emplace_back(units.addresses[u], &units.channels[u]);
        const auto number = units.names[u].substr(units.names[u].rfind('#') + 1);
        any_named = any_named || units.channels[u] != "ch" + number;
    }
    if (!any_named) return {};
    std::sort(on.begin(), on.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<aer::NameRun> runs;
    for (const auto& [address, name] : on) {
        if (!runs.empty() && runs.back().name == *name && address == runs.back().address + runs.back().count)
            ++runs.back().count;
        else
            runs.push_back({address, 1, 0, 1, *name});
    }
    return runs;
}

/// "0, 2 ... 30"
std::string addresses_of(const aer::NameRun& run) {
    const auto last = run.address + std::uint64_t{run.stride} * (run.count - 1);
    return run.count == 1   ? fmt::format("address {}", run.address)
           : run.count == 2 ? fmt::format("addresses {}, {}", run.address, last)
                            : fmt::format("addresses {}, {} ... {}", run.address, run.address + run.stride, last);
}

std::string one_line(std::string text) {
    std::replace_if(text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 0x7f; }, ' ');
    return text;
}

/// The meaning of the addresses, as comments of at most 32 kB. Readers look for the events within the first 64 kB.
std::string comments_of(const EventUnits& units) {
    constexpr std::size_t most = std::size_t{1} << 15;
    std::string text;
    const auto add = [&](const std::string& comment) {
        if (text.size() + comment.size() > most) return false;
        text += "# " + one_line(comment) + "\r\n";
        return true;
    };
    bool all = true;
    for (const auto& r : runs_of(units))
        all = all && add(r.number == 0  ? fmt::format("{}: {}", addresses_of(r), r.name)
                         : r.count == 1 ? fmt::format("{}: {}#{}", addresses_of(r), r.name, r.number)
                                        : fmt::format("{}: {}#{} ... {}#{}", addresses_of(r), r.name, r.number, r.name,
                                                      std::uint64_t{r.number} + r.count - 1));
    for (const auto& r : channel_runs_of(units)) all = all && add(fmt::format("{}: channel {}", addresses_of(r), r.name));
    return all ? text : text + "# and others\r\n";
}

template <class T>
void add_number(std::string& text, T number) {
    text.append(reinterpret_cast<const char*>(&number), sizeof number);
}

void add_runs(std::string& text, const std::vector<aer::NameRun>& runs) {
    for (const auto& r : runs) {
        for (const auto number : {r.address, r.stride, r.number, r.count, static_cast<std::uint32_t>(r.name.size())})
            add_number(text, number);
        text += r.name;
        text.append((4 - r.name.size() % 4) % 4, '\0');
    }
}

class AerEvents final : public EventFormat {
    EventUnits units_;

public:
    explicit AerEvents(const EventUnits& units) : units_(units) {}
    std::string_view name() const override { return "aer"; }
    std::size_t most_bytes() const override { return aer::spike_bytes; }
    bool same_size() const override { return true; }

    std::string header() const override {
        std::string names;
        const auto runs = runs_of(units_), channels = channel_runs_of(units_);
        add_runs(names, runs);
        if (!channels.empty()) add_number(names, static_cast<std::uint32_t>(channels.size())), add_runs(names, channels);
        std::string text(aer::magic);
        add_number(text, units_.clock.per), add_number(text, units_.clock.seconds);
        add_number(text, static_cast<std::uint32_t>(runs.size())), add_number(text, static_cast<std::uint32_t>(names.size()));
        return text + names;
    }

    std::size_t put(const Spike& s, char* at) const override {
        const aer::Packed packed{s.step, aer::place_of(s.offset), units_.addresses[s.unit]};
        std::memcpy(at, &packed, sizeof packed);
        return sizeof packed;
    }
};

class Aedat2Events final : public EventFormat {
    EventTime time_;
    std::vector<std::uint32_t> addresses_;
    std::string comments_;

    static void put_big(std::uint32_t number, char* at) {
        for (int k = 3; k >= 0; --k) at[k] = static_cast<char>(number & 0xff), number >>= 8;
    }

public:
    explicit Aedat2Events(const EventUnits& units) : time_(units.clock), addresses_(units.addresses), comments_(comments_of(units)) {}
    std::string_view name() const override { return "aedat2"; }
    std::size_t most_bytes() const override { return 8; }
    bool same_size() const override { return true; }
    std::string header() const override {
        return "#!AER-DAT2.0\r\n# spikes of afferents: address, microseconds modulo 2^32\r\n" + comments_;
    }
    std::size_t put(const Spike& s, char* at) const override {
        put_big(addresses_[s.unit], at);
        put_big(static_cast<std::uint32_t>((time_.nanoseconds(s) + 500) / 1000), at + 4);
        return 8;
    }
};

}  // namespace

std::unique_ptr<EventFormat> aer_events(const EventUnits& units) { return std::make_unique<AerEvents>(units); }
std::unique_ptr<EventFormat> aedat2_events(const EventUnits& units) { return std::make_unique<Aedat2Events>(units); }

}  // namespace corpuscle
