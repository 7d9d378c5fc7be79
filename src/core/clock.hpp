#pragma once
// The times of samples: sample k is at t0 + k T, where the sample period T is a ratio of integers. Times are computed from sample numbers,
// never by adding T repeatedly, so they have no drift.

#include <cstdint>

#include "core/error.hpp"

namespace corpuscle {

struct Clock {
    std::int64_t rate_numerator = 1;    ///< number of samples in `rate_denominator` seconds
    std::int64_t rate_denominator = 1;  ///< s; T = rate_denominator / rate_numerator
    double t0 = 0;                      ///< s, time of sample 0

    /// The sample period in s.
    double T() const { return static_cast<double>(rate_denominator) / static_cast<double>(rate_numerator); }
    /// Samples per second.
    double rate() const { return static_cast<double>(rate_numerator) / static_cast<double>(rate_denominator); }
    /// The time in s of a point in the interval that ends at sample `step`. `offset` in (0, 1] is its position in this interval; 1 is the
    /// sample itself.
    double time(std::int64_t step, double offset = 1) const {
        return t0 +
               ((static_cast<double>(step) - 1) + offset) * static_cast<double>(rate_denominator) / static_cast<double>(rate_numerator);
    }
};

/// The clock of `rate` samples per second. The ratio is the simplest one within the relative `tolerance` of the rate: 242.6 Hz is 1213
/// samples in 5 s. A rate outside [1e-6, 1e12] Hz is an error.
Result<Clock> make_clock(double rate, double t0 = 0, double tolerance = 1e-12);

}  // namespace corpuscle
