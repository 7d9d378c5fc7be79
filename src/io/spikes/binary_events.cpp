#include <fmt/format.h>

#include "core/bytes.hpp"
#include "core/text/ascii_text.hpp"
#include "io/spikes/address_events.hpp"
#include "io/spikes/events.hpp"

namespace corpuscle {
namespace {

namespace aer = address_events;

/// The run of a single afferent. Splits its name: "sa1#17" has the name sa1 and the number 17. The number is 0 if the name has none.
aer::NameRun run_of(const std::string& name, std::uint32_t address) {
    const auto sign = name.rfind('#');
    const auto digits = std::string_view(name).substr(sign == name.npos ? name.size() : sign + 1);
    const auto number = parse_bare_number<std::uint32_t>(digits);
    if (!number || digits[0] == '0') return {address, 1, 0, 1, name};  // a number such as 017 would be written back as 17
    return {address, 1, *number, 1, name.substr(0, sign)};
}

/// Adds the afferent of `next`, a run of one afferent, to `run` if its number and address continue that run. Otherwise returns false.
bool extend(aer::NameRun& run, const aer::NameRun& next) {
    if (run.first_number == 0 || next.first_number != run.first_number + run.count || next.name != run.name ||
        next.first_address <= run.first_address)
        return false;
    if (run.count == 1) run.stride = next.first_address - run.first_address;
    if (next.first_address != run.first_address + static_cast<std::uint64_t>(run.stride) * run.count) return false;
    ++run.count;
    return true;
}

/// The names of all afferents as runs.
std::vector<aer::NameRun> runs_of(const EventAddressing& addressing) {
    std::vector<aer::NameRun> runs;
    for (std::size_t u = 0; u < addressing.names.size(); ++u) {
        auto next = run_of(addressing.names[u], addressing.addresses[u]);
        if (runs.empty() || !extend(runs.back(), next)) runs.push_back(std::move(next));
    }
    return runs;
}

/// The channels as runs of addresses, sorted by address. Empty if the file does not need them: if EventAddressing::names and afferents are
/// equal, or if each afferent's number is that of its channel, such as sa1#17 on ch17.
std::vector<aer::NameRun> channel_runs_of(const EventAddressing& addressing) {
    std::vector<std::pair<std::uint32_t, const std::string*>> channel_at;
    bool any_named = false;  // true if a channel has a name other than "ch" and the afferent's number
    for (std::size_t u = 0; u < addressing.afferents.size() && u < addressing.channels.size(); ++u) {
        if (addressing.afferents[u] == addressing.names[u]) return {};
        channel_at.emplace_back(addressing.addresses[u], &addressing.channels[u]);
        const auto number = addressing.names[u].substr(addressing.names[u].rfind('#') + 1);
        any_named = any_named || addressing.channels[u] != "ch" + number;
    }
    if (!any_named) return {};
    std::sort(channel_at.begin(), channel_at.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<aer::NameRun> runs;
    for (const auto& [address, name] : channel_at) {
        if (!runs.empty() && runs.back().name == *name && address == runs.back().first_address + runs.back().count)
            ++runs.back().count;
        else
            runs.push_back({address, 1, 0, 1, *name});
    }
    return runs;
}

/// The addresses of a run as text: "addresses 0, 2 ... 30".
std::string addresses_of(const aer::NameRun& run) {
    const auto last = run.first_address + std::uint64_t{run.stride} * (run.count - 1);
    return run.count == 1   ? fmt::format("address {}", run.first_address)
           : run.count == 2 ? fmt::format("addresses {}, {}", run.first_address, last)
                            : fmt::format("addresses {}, {} ... {}", run.first_address, run.first_address + run.stride, last);
}

/// The text with a blank for each control character, such as a line break.
std::string one_line(std::string text) {
    std::replace_if(text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 0x7f; }, ' ');
    return text;
}

/// The meaning of the addresses as comments. They are cut off at 32 kB, because readers expect the first event within the first 64 kB.
std::string comments_of(const EventAddressing& addressing) {
    constexpr std::size_t limit = std::size_t{1} << 15;
    std::string text;
    const auto add = [&](const std::string& comment) {
        if (text.size() + comment.size() > limit) return false;
        text += "# " + one_line(comment) + "\r\n";
        return true;
    };
    bool all = true;  // false if the comments were cut off
    for (const auto& r : runs_of(addressing))
        all = all && add(r.first_number == 0 ? fmt::format("{}: {}", addresses_of(r), r.name)
                         : r.count == 1      ? fmt::format("{}: {}#{}", addresses_of(r), r.name, r.first_number)
                                             : fmt::format("{}: {}#{} ... {}#{}", addresses_of(r), r.name, r.first_number, r.name,
                                                           std::uint64_t{r.first_number} + r.count - 1));
    for (const auto& r : channel_runs_of(addressing)) all = all && add(fmt::format("{}: channel {}", addresses_of(r), r.name));
    return all ? text : text + "# and others\r\n";  // addresses that are not listed
}

/// Appends runs as they are in the header of address events, see address_events.hpp.
void put_runs(ByteWriter<>& out, const std::vector<aer::NameRun>& runs) {
    for (const auto& r : runs) {
        out.put(r.first_address, r.stride, r.first_number, r.count, static_cast<std::uint32_t>(r.name.size()));
        out.put_raw(r.name.data(), r.name.size());
        out.put_raw("\0\0\0", (4 - r.name.size() % 4) % 4);
    }
}

class AerEvents final : public EventFormat {
    EventAddressing addressing_;

public:
    explicit AerEvents(const EventAddressing& addressing) : addressing_(addressing) {}
    std::string_view name() const override { return "aer"; }
    std::size_t max_bytes() const override { return aer::spike_bytes; }
    bool has_fixed_size() const override { return true; }

    std::string header() const override {
        ByteWriter names, out;
        const auto runs = runs_of(addressing_), channels = channel_runs_of(addressing_);
        put_runs(names, runs);
        if (!channels.empty()) names.put(static_cast<std::uint32_t>(channels.size())), put_runs(names, channels);
        out.put_raw(aer::magic.data(), aer::magic.size());
        out.put(addressing_.clock.rate_numerator, addressing_.clock.rate_denominator, static_cast<std::uint32_t>(runs.size()),
                static_cast<std::uint32_t>(names.bytes().size()));
        return out.take() + names.bytes();
    }

    std::size_t write(const Spike& s, char* at) const override {
        const aer::EncodedSpike packed{s.step, aer::encode_offset(s.offset), addressing_.addresses[s.afferent_index]};
        std::memcpy(at, &packed, sizeof packed);
        return sizeof packed;
    }
};

class Aedat2Events final : public EventFormat {
    EventTime time_;
    std::vector<std::uint32_t> addresses_;
    std::string comments_;

    static void put_big_endian(std::uint32_t number, char* at) {
        for (int k = 3; k >= 0; --k) at[k] = static_cast<char>(number & 0xff), number >>= 8;
    }

public:
    explicit Aedat2Events(const EventAddressing& addressing)
        : time_(addressing.clock), addresses_(addressing.addresses), comments_(comments_of(addressing)) {}
    std::string_view name() const override { return "aedat2"; }
    std::size_t max_bytes() const override { return 8; }
    bool has_fixed_size() const override { return true; }
    std::string header() const override {
        return "#!AER-DAT2.0\r\n# spikes of afferents: address, microseconds modulo 2^32\r\n" + comments_;
    }
    std::size_t write(const Spike& s, char* at) const override {
        put_big_endian(addresses_[s.afferent_index], at);
        put_big_endian(static_cast<std::uint32_t>((time_.nanoseconds(s) + 500) / 1000), at + 4);
        return 8;
    }
};

}  // namespace

std::unique_ptr<EventFormat> make_aer_format(const EventAddressing& addressing) { return std::make_unique<AerEvents>(addressing); }
std::unique_ptr<EventFormat> make_aedat2_format(const EventAddressing& addressing) { return std::make_unique<Aedat2Events>(addressing); }

}  // namespace corpuscle
