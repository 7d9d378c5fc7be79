#pragma once
// Spike times as integer nanoseconds, with a precision that does not depend on the length of the stream.

#include <cmath>

#include "signal/spike.hpp"

namespace corpuscle {

/// The clock has rate_numerator samples in rate_denominator seconds. Such cycles are counted as integers, and only the remainder of less
/// than one cycle is a double. So a spike after a year is as precise as the first one.
class EventTime {
    std::int64_t per_, cycle_, start_;  // samples; ns; ns
    double step_;                       // ns

public:
    explicit EventTime(const Clock& clock)
        : per_(clock.per), cycle_(clock.seconds * 1'000'000'000), start_(std::llround(clock.t0 * 1e9)),
          step_(static_cast<double>(clock.seconds) * 1e9 / static_cast<double>(clock.per)) {}

    /// The time of the spike, rounded to the nearest nanosecond.
    std::int64_t nanoseconds(const Spike& s) const {
        std::int64_t cycles = (s.step - 1) / per_, rest = (s.step - 1) % per_;
        if (rest < 0) rest += per_, --cycles;
        return start_ + cycles * cycle_ + static_cast<std::int64_t>(std::floor((static_cast<double>(rest) + s.offset) * step_ + 0.5));
    }
};

}  // namespace corpuscle
