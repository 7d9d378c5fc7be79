#pragma once
// The quality report of a recording: one message for each fault, with a remedy. It is a warning if the response is doubtful.

#include <vector>

#include "io/channel_path.hpp"
#include "io/row_clock.hpp"
#include "signal/source.hpp"

namespace corpuscle {

struct RowCounts {
    std::int64_t dropped = 0, out_of_range = 0;
};

Quality verdict(const std::vector<Channel>&, const std::vector<ChannelPath>&, const RowClock&, const RowCounts&, const SumCheck&);

}  // namespace corpuscle
