#pragma once
// The time base: sample k is at t0 + k T, where T is an exact fraction of a second. Times are computed from sample
// numbers, never accumulated.

#include <cstdint>

#include "signal/error.hpp"

namespace corpuscle {

struct Clock {
    std::int64_t rate_numerator = 1;    ///< number of samples in `rate_denominator` seconds
    std::int64_t rate_denominator = 1;  ///< s; T = rate_denominator / rate_numerator
    double t0 = 0;                      ///< s, time of sample 0

    double T() const { return static_cast<double>(rate_denominator) / static_cast<double>(rate_numerator); }
    double rate() const { return static_cast<double>(rate_numerator) / static_cast<double>(rate_denominator); }
    /// The time in s of the point at fraction `offset`, in (0, 1], of the interval that ends at sample `step`.
    double time(std::int64_t step, double offset = 1) const {
        return t0 +
               ((static_cast<double>(step) - 1) + offset) * static_cast<double>(rate_denominator) / static_cast<double>(rate_numerator);
    }
};

/// The clock of `rate` samples per second, as the simplest fraction within the relative `tolerance`: 242.6 Hz is 1213 samples
/// in 5 s. A rate outside [1e-6, 1e12] Hz is an error.
Result<Clock> make_clock(double rate, double t0 = 0, double tolerance = 1e-12);

}  // namespace corpuscle
