#pragma once
// The quality report of a recording: one message for each fault, with a remedy. It is a warning if the response is doubtful.

#include <vector>

#include "io/channel_pipeline.hpp"
#include "io/row_clock.hpp"
#include "signal/force_source.hpp"

namespace corpuscle {

struct RowCounts {
    std::int64_t dropped = 0, out_of_range = 0;
};

RecordingQuality assess_quality(const std::vector<Channel>&, const std::vector<ChannelPipeline>&, const RowClock&, const RowCounts&,
                                const SumDetector&);

}  // namespace corpuscle
