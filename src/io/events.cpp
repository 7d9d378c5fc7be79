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
    {"lines", ".csv", "text, a line a spike: time_s,afferent"},
    {"jsonl", ".jsonl", R"(JSON, a line a spike: {"time_s":0.250000000,"afferent":"sa1#17","address":33})"},
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

/// A time between two texts, of which the second is the unit's own.
class TextEvents final : public EventFormat {
    static constexpr std::size_t longest_time = 21 + 10;
    std::string_view name_;
    EventTime time_;
    std::string header_, before_, behind_;
    std::vector<std::size_t> begin_ = {0};  // of each unit, in behind_
    std::size_t most_ = 0;

public:
    TextEvents(std::string_view name, const Clock& clock, std::string header, std::string before)
        : name_(name), time_(clock), header_(std::move(header)), before_(std::move(before)) {}

    void add(const std::string& behind) {
        behind_ += behind;
        begin_.push_back(behind_.size());
        most_ = std::max(most_, before_.size() + longest_time + behind.size());
    }

    std::string_view name() const override { return name_; }
    std::size_t most_bytes() const override { return most_; }
    std::string header() const override { return header_; }
    std::size_t put(const Spike& s, char* const at) const override {
        char* end = std::copy(before_.begin(), before_.end(), at);
        end = put_seconds(time_.nanoseconds(s), end);
        const char* const text = behind_.data();
        end = std::copy(text + begin_[s.unit], text + begin_[s.unit + 1], end);
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
    if (units.addresses.size() != units.names.size())
        return bad_input(fmt::format("{} units have {} addresses", units.names.size(), units.addresses.size()));
    if (name == "aer") return aer_events(units);
    if (name == "aedat2") return aedat2_events(units);
    if (name == "lines") {
        auto lines = std::make_unique<TextEvents>("lines", units.clock, "time_s,afferent\n", "");
        for (const auto& n : units.names) lines->add("," + csv_field(n) + "\n");
        return Result<std::unique_ptr<EventFormat>>(std::move(lines));
    }
    if (name == "jsonl") {
        auto lines = std::make_unique<TextEvents>("jsonl", units.clock, "", R"({"time_s":)");
        for (std::size_t u = 0; u < units.names.size(); ++u)
            lines->add(fmt::format(",\"afferent\":{},\"address\":{}}}\n", json_text(units.names[u]), units.addresses[u]));
        return Result<std::unique_ptr<EventFormat>>(std::move(lines));
    }
    std::vector<std::string_view> known;
    for (const auto& f : event_format_names) known.push_back(f.name);
    return bad_usage(
        fmt::format("no format of events is called '{}'{}; there are {}", name, did_you_mean(name, known), fmt::join(known, ", ")));
}

}  // namespace corpuscle
