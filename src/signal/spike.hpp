#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "signal/clock.hpp"

namespace corpuscle {

/// One spike: in the interval that ends at sample `step`, `offset` of the way through it. Its time is Clock::time(step, offset).
struct Spike {
    std::int64_t step = 0;
    double offset = 1;       ///< in (0, 1]; 1 on the sample itself
    std::uint32_t unit = 0;  ///< which afferent on which channel

    friend auto operator<=>(const Spike&, const Spike&) = default;  // time, then unit
};

/// The times of a train, s, in order.
std::vector<double> times(std::span<const Spike> train, const Clock& clock);

}  // namespace corpuscle
