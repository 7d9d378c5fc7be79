#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "signal/clock.hpp"

namespace corpuscle {

/// A spike at the fraction `offset` of the interval that ends at sample `step`. Its time is Clock::time(step, offset).
struct Spike {
    std::int64_t step = 0;
    double offset = 1;                 ///< in (0, 1]; 1 is the sample itself
    std::uint32_t afferent_index = 0;  ///< one index for each afferent on each channel

    friend auto operator<=>(const Spike&, const Spike&) = default;  // by time, then by afferent
};

/// The spike times of a train in s, in the train's order.
std::vector<double> spike_times(std::span<const Spike> train, const Clock& clock);

}  // namespace corpuscle
