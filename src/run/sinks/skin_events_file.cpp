#include "run/sinks/skin_events_file.hpp"

#include "live/live_population.hpp"

namespace corpuscle {

Result<void> SkinEventsFile::begin(const SkinInput& input) {
    auto format = make_event_format(format_name_, make_event_addressing(input.skin, input.clock));
    if (!format) return format.error();
    format_ = std::move(*format);
    return file_.write(format_->header());
}

Result<void> SkinEventsFile::put(std::span<const Spike> spikes) {
    bytes_.resize(spikes.size() * format_->max_bytes());
    char* at = bytes_.data();
    for (const auto& s : spikes) at += format_->write(s, at);
    return file_.write({bytes_.data(), static_cast<std::size_t>(at - bytes_.data())});
}

}  // namespace corpuscle
