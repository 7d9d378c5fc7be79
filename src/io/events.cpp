#include "io/events.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>

#include "io/event_formats.hpp"
#include "io/event_time.hpp"
#include "io/spikes.hpp"
#include "signal/field.hpp"

namespace corpuscle {
namespace {

constexpr EventFormatName event_format_names[] = {
    {"lines", ".csv", "text, a line a spike: afferent,channel,time_s"},
    {"jsonl", ".jsonl", R"(JSON, a line a spike: {"time_s":0.250000000,"afferent":"sa1","channel":"ch17","address":32})"},
    {"aer", ".aer", "binary address events, 16 bytes a spike, behind a header that names the units; all of a spike's time"},
    {"aedat2", ".aedat", "AEDAT 2.0, as jAER reads it: address and microseconds, 4 bytes each"},
};

/// Whole seconds, a point and nine digits; where it ends.
char* put_seconds(std::int64_t ns, char* at) {
    if (ns < 0) *at++ = '-', ns = -ns;
    constexpr std::int64_t second = 1'000'000'000;
    at = std::to_chars(at, at + 20, ns / second).ptr;
    *at = '.';
    auto rest = ns % second;
    for (int k = 9; k > 0; --k) at[k] = static_cast<char>('0' + rest % 10), rest /= 10;
    return at + 10;
}

/// A time between two texts, which are the unit's own.
class TextEvents final : public EventFormat {
    static constexpr std::size_t longest_time = 21 + 10;
    std::string_view name_;
    EventTime time_;
    std::string header_, texts_;
    std::vector<std::size_t> begin_ = {0};  // of each unit's two texts, one after the other, in texts_
    std::size_t most_ = 0;

    std::string_view text(std::size_t k) const { return std::string_view(texts_).substr(begin_[k], begin_[k + 1] - begin_[k]); }

public:
    TextEvents(std::string_view name, const Clock& clock, std::string header) : name_(name), time_(clock), header_(std::move(header)) {}

    void add(const std::string& before, const std::string& behind) {
        for (const auto* text : {&before, &behind}) {
            texts_ += *text;
            begin_.push_back(texts_.size());
        }
        most_ = std::max(most_, before.size() + longest_time + behind.size());
    }

    std::string_view name() const override { return name_; }
    std::size_t most_bytes() const override { return most_; }
    std::string header() const override { return header_; }
    std::size_t put(const Spike& s, char* const at) const override {
        const auto before = text(2 * std::size_t{s.unit}), behind = text(2 * std::size_t{s.unit} + 1);
        char* end = std::copy(before.begin(), before.end(), at);
        end = put_seconds(time_.nanoseconds(s), end);
        end = std::copy(behind.begin(), behind.end(), end);
        return static_cast<std::size_t>(end - at);
    }
};

std::string json_text(const std::string& text) {
    return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

std::span<const EventFormatName> event_formats() { return event_format_names; }

Result<std::unique_ptr<EventFormat>> event_format(std::string_view name, EventUnits units) {
    if (units.addresses.empty())
        for (std::size_t u = 0; u < units.names.size(); ++u) units.addresses.push_back(static_cast<std::uint32_t>(u));
    if (units.afferents.empty()) units.afferents = units.names;
    const bool is_on_channels = !units.channels.empty();
    if (!is_on_channels) units.channels.resize(units.names.size());
    for (const auto size : {units.addresses.size(), units.afferents.size(), units.channels.size()})
        if (size != units.names.size()) return bad_input(fmt::format("{} units have {} addresses or names", units.names.size(), size));
    if (name == "aer") return aer_events(units);
    if (name == "aedat2") return aedat2_events(units);
    if (name == "lines") {
        auto lines = std::make_unique<TextEvents>("lines", units.clock, "afferent,channel,time_s\n");
        for (std::size_t u = 0; u < units.names.size(); ++u)
            lines->add(csv_field(units.afferents[u]) + "," + csv_field(units.channels[u]) + ",", "\n");
        return Result<std::unique_ptr<EventFormat>>(std::move(lines));
    }
    if (name == "jsonl") {
        auto lines = std::make_unique<TextEvents>("jsonl", units.clock, "");
        for (std::size_t u = 0; u < units.names.size(); ++u)
            lines->add(R"({"time_s":)",
                       fmt::format(",\"afferent\":{}{},\"address\":{}}}\n", json_text(units.afferents[u]),
                                   is_on_channels ? ",\"channel\":" + json_text(units.channels[u]) : "", units.addresses[u]));
        return Result<std::unique_ptr<EventFormat>>(std::move(lines));
    }
    std::vector<std::string_view> known;
    for (const auto& f : event_format_names) known.push_back(f.name);
    return bad_usage(
        fmt::format("no format of events is called '{}'{}; there are {}", name, did_you_mean(name, known), fmt::join(known, ", ")));
}

}  // namespace corpuscle
