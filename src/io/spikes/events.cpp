#include "io/spikes/events.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>

#include "core/parameter.hpp"
#include "core/text/ascii_text.hpp"
#include "core/text/csv_field.hpp"

namespace corpuscle {
namespace {

constexpr EventFormatInfo event_format_names[] = {
    {"lines", ".csv", "text, one line for each spike: afferent,channel,time_s"},
    {"jsonl", ".jsonl", R"(JSON, one line for each spike: {"time_s":0.250000000,"afferent":"sa1","channel":"ch17","address":32})"},
    {"aer", ".aer", "binary address events, 16 bytes for each spike, after a header that names the afferents; exact times"},
    {"aedat2", ".aedat", "AEDAT 2.0 for jAER: address and microseconds, 4 bytes each"},
};

/// Writes a time in ns as seconds with nine decimals. Returns the end of the text.
char* put_seconds(std::int64_t ns, char* at) {
    if (ns < 0) *at++ = '-', ns = -ns;
    constexpr std::int64_t second = 1'000'000'000;
    at = std::to_chars(at, at + 20, ns / second).ptr;
    *at = '.';
    auto rest = ns % second;
    for (int k = 9; k > 0; --k) at[k] = static_cast<char>('0' + rest % 10), rest /= 10;
    return at + 10;
}

/// A text format. The line of a spike consists of its time, and of one text before and one after it that depend only on the afferent.
class TextEvents final : public EventFormat {
    static constexpr std::size_t max_time = 21 + 10;  // bytes of a time: sign and seconds, then the point and nine decimals
    std::string_view name_;
    EventTime time_;
    std::string header_;
    std::string texts_;                     // for each afferent, the text before the time and the text after it
    std::vector<std::size_t> begin_ = {0};  // positions in texts_ at which these texts begin, and the end of the last one
    std::size_t max_bytes_ = 0;

    /// Text number k of texts_: 2 a is the text before the time of afferent a, 2 a + 1 the text after it.
    std::string_view text(std::size_t k) const { return std::string_view(texts_).substr(begin_[k], begin_[k + 1] - begin_[k]); }

public:
    TextEvents(std::string_view name, const Clock& clock, std::string header) : name_(name), time_(clock), header_(std::move(header)) {}

    /// Adds the next afferent, in the order of the afferent indices.
    void add(const std::string& before, const std::string& after) {
        for (const auto* text : {&before, &after}) {
            texts_ += *text;
            begin_.push_back(texts_.size());
        }
        max_bytes_ = std::max(max_bytes_, before.size() + max_time + after.size());
    }

    std::string_view name() const override { return name_; }
    std::size_t max_bytes() const override { return max_bytes_; }
    std::string header() const override { return header_; }
    std::size_t write(const Spike& s, char* const at) const override {
        const auto before = text(2 * std::size_t{s.afferent_index}), after = text(2 * std::size_t{s.afferent_index} + 1);
        char* end = std::copy(before.begin(), before.end(), at);
        end = put_seconds(time_.nanoseconds(s), end);
        end = std::copy(after.begin(), after.end(), end);
        return static_cast<std::size_t>(end - at);
    }
};

/// The text as a JSON string. Bytes that are not UTF-8 are replaced.
std::string quoted_json(const std::string& text) {
    return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

std::span<const EventFormatInfo> event_formats() { return event_format_names; }

Result<std::unique_ptr<EventFormat>> make_event_format(std::string_view name, EventAddressing addressing) {
    if (addressing.addresses.empty())
        for (std::size_t u = 0; u < addressing.names.size(); ++u) addressing.addresses.push_back(static_cast<std::uint32_t>(u));
    if (addressing.afferents.empty()) addressing.afferents = addressing.names;
    const bool is_on_channels = !addressing.channels.empty();
    if (!is_on_channels) addressing.channels.resize(addressing.names.size());
    for (const auto size : {addressing.addresses.size(), addressing.afferents.size(), addressing.channels.size()})
        if (size != addressing.names.size())
            return bad_input(fmt::format("{} afferents have {} addresses or names", addressing.names.size(), size));
    if (name == "aer") return make_aer_format(addressing);
    if (name == "aedat2") return make_aedat2_format(addressing);
    if (name == "lines") {
        auto lines = std::make_unique<TextEvents>("lines", addressing.clock, "afferent,channel,time_s\n");
        for (std::size_t u = 0; u < addressing.names.size(); ++u)
            lines->add(quote_csv_field(addressing.afferents[u]) + "," + quote_csv_field(addressing.channels[u]) + ",", "\n");
        return Result<std::unique_ptr<EventFormat>>(std::move(lines));
    }
    if (name == "jsonl") {
        auto lines = std::make_unique<TextEvents>("jsonl", addressing.clock, "");
        for (std::size_t u = 0; u < addressing.names.size(); ++u)
            lines->add(R"({"time_s":)",
                       fmt::format(",\"afferent\":{}{},\"address\":{}}}\n", quoted_json(addressing.afferents[u]),
                                   is_on_channels ? ",\"channel\":" + quoted_json(addressing.channels[u]) : "", addressing.addresses[u]));
        return Result<std::unique_ptr<EventFormat>>(std::move(lines));
    }
    std::vector<std::string_view> known;
    for (const auto& f : event_format_names) known.push_back(f.name);
    return bad_usage(fmt::format("unknown event format '{}'{}; formats: {}", name, did_you_mean(name, known), joined(known)));
}

}  // namespace corpuscle
