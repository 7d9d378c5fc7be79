#pragma once
// The quality report of a recording: a message for each kind of fault, with a remedy. A message is a warning if the fault makes the
// response of the afferents doubtful.

#include "io/recording/force_rows.hpp"
#include "io/recording/row_clock.hpp"

namespace corpuscle {

/// Assesses the part of the recording that has been read. `rows` are those of `channels`, in the same order.
RecordingQuality assess_quality(const std::vector<Channel>&, const ForceRows& rows, const RowClock&);

}  // namespace corpuscle
