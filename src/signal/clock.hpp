#pragma once
// The time base: sample k stands at t0 + k T, with T an exact fraction of a second. Times are derived from sample
// numbers, never accumulated.

#include <cstdint>

#include "signal/error.hpp"

namespace corpuscle {

struct Clock {
    std::int64_t per = 1;      ///< T = seconds / per: `per` samples ...
    std::int64_t seconds = 1;  ///< ... in this many seconds
    double t0 = 0;             ///< s, time of sample 0

    double T() const { return static_cast<double>(seconds) / static_cast<double>(per); }
    double rate() const { return static_cast<double>(per) / static_cast<double>(seconds); }
    /// Time of the point `offset` (0, 1] through the interval that ends at sample `step`; s.
    double time(std::int64_t step, double offset = 1) const {
        return t0 + ((static_cast<double>(step) - 1) + offset) * static_cast<double>(seconds) / static_cast<double>(per);
    }
};

/// The clock of `rate` samples a second, as a simple fraction within `tolerance` (relative) of it: 242.6 Hz is 1213 samples
/// in 5 s. Refuses what is not in [1e-6, 1e12] Hz.
Result<Clock> clock_of(double rate, double t0 = 0, double tolerance = 1e-12);

}  // namespace corpuscle
