#pragma once
// The quality report of a recording: one message for each fault, with a remedy. A message is a warning if the fault makes the
// response doubtful.

#include <vector>

#include "io/channel_pipeline.hpp"
#include "io/row_clock.hpp"
#include "signal/force_source.hpp"

namespace corpuscle {

struct RowCounts {
    std::int64_t dropped = 0, out_of_range = 0;  ///< rows with a bad field; values outside --range
};

RecordingQuality assess_quality(const std::vector<Channel>&, const std::vector<ChannelPipeline>&, const RowClock&, const RowCounts&,
                                const SumDetector&);

}  // namespace corpuscle
