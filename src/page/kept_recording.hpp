#pragma once
// The recording that an engine keeps for `respond`, so that its force need not travel to the page and back.

#include <memory>

#include "core/force_source.hpp"

namespace corpuscle::page {

struct KeptRecording {
    std::string name;  ///< of the source, for messages
    std::vector<Channel> channels;
    Clock clock;
    /// The force of each channel, N. A simulation may still use it when the recording is replaced.
    std::vector<std::shared_ptr<const std::vector<double>>> force;
    RecordingQuality quality;

    /// The metrics of one channel, as those of a recording that has no other.
    RecordingQuality quality_of(std::uint32_t channel) const {
        RecordingQuality out;
        for (auto metric : quality.metrics)
            if (metric.channel == channel) metric.channel = 0, out.metrics.push_back(metric);
        return out;
    }
};

}  // namespace corpuscle::page
