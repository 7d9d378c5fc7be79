#pragma once
// The quality report of a recording: a message for each kind of fault, with a remedy. A message is a warning if the fault makes the
// response of the afferents doubtful.

#include "io/recording/channel_pipeline.hpp"
#include "io/recording/row_clock.hpp"

namespace corpuscle {

struct RowCounts {
    std::int64_t dropped = 0;       ///< number of rows that were dropped because they have a bad field
    std::int64_t out_of_range = 0;  ///< number of values outside --range
};

/// Assesses the part of the recording that has been read. `pipelines` are those of `channels`, in the same order.

RecordingQuality assess_quality(const std::vector<Channel>&, const std::vector<ChannelPipeline>&, const RowClock&, const RowCounts&,
                                const SumDetector&);

}  // namespace corpuscle
