// Spikes as events (doc/events.md), in one of several formats: spikes.aer for the first input, spikes-2.aer for the second.

#include <algorithm>

#include "core/text/ascii_text.hpp"
#include "io/spikes/events.hpp"
#include "run/sinks/file_sink.hpp"

namespace corpuscle {
namespace {

/// The requested format; null if its name is unknown.
const EventFormatInfo* requested_format(const OutputRequest& request) {
    const auto formats = event_formats();
    const auto at = std::ranges::find(formats, request.options.at("--events"), &EventFormatInfo::name);
    return at == formats.end() ? nullptr : &*at;
}

class EventsFile final : public SpikeFileSink {
    std::string_view format_name_;
    std::string extension_;
    std::unique_ptr<EventFormat> format_;
    std::string bytes_;  // of the current block

    Result<void> add(const Input& input, std::span<const Spike> spikes) override {
        bytes_.resize(spikes.size() * format_->max_bytes());
        char* at = bytes_.data();
        for (auto s : spikes) {
            s.afferent_index -= input.first_afferent;
            at += format_->write(s, at);
        }
        return files_.back().write({bytes_.data(), static_cast<std::size_t>(at - bytes_.data())});
    }

public:
    explicit EventsFile(const OutputRequest& request)
        : SpikeFileSink(request), format_name_(requested_format(request)->name), extension_(requested_format(request)->extension) {}
    Result<void> open() { return create("spikes" + extension_); }
    Result<void> begin(const Input& input) override {
        if (input.index > 0) TRY(create(numbered_name("spikes#" + extension_, input.index)));
        format_ = TRY(make_event_format(format_name_, input.population.event_addressing(input.clock)));
        return files_.back().write(format_->header());
    }
};

Result<void> check_event_format(const OutputRequest& request) {
    if (requested_format(request)) return {};
    const auto& name = request.options.at("--events");
    std::vector<std::string_view> names;
    for (const auto& f : event_formats()) names.push_back(f.name);
    return bad_usage(fmt::format("--events {}: expected one of {}{}", name, joined(names), did_you_mean(name, names)));
}

std::vector<std::string> event_file_names(const OutputRequest& request) {
    std::vector<std::string> names;
    const auto name = fmt::format("spikes#{}", requested_format(request)->extension);
    for (std::size_t k = 0; k < request.inputs; ++k) names.push_back(numbered_name(name, k));
    return names;
}

}  // namespace

extern const OutputFormat events_format = {
    .names = {"spikes#.csv", "spikes#.jsonl", "spikes#.aer", "spikes#.aedat"},
    .option = "--events",
    .value_name = "FORMAT",
    .help = "write the spikes as lines, jsonl, aer or aedat2 (doc/events.md) instead of spikes.csv",
    .make = make_file_sink<EventsFile>,
    .check = check_event_format,
    .names_of = event_file_names,
};

}  // namespace corpuscle
