#pragma once
// Spike times as integer nanoseconds. Their precision does not depend on the length of the stream.

#include <cmath>

#include "core/spike.hpp"

namespace corpuscle {

/// A cycle is rate_numerator samples, which last rate_denominator seconds. Complete cycles are counted as integers, and only the
/// remainder is a double, so a spike after a year is as precise as the first one.
class EventTime {
    std::int64_t samples_per_cycle_, cycle_ns_, start_ns_;  // cycle_ns_: length of a cycle; start_ns_: time of sample 0
    double sample_ns_;                                      // sample period

public:
    explicit EventTime(const Clock& clock)
        : samples_per_cycle_(clock.rate_numerator), cycle_ns_(clock.rate_denominator * 1'000'000'000),
          start_ns_(std::llround(clock.t0 * 1e9)),
          sample_ns_(static_cast<double>(clock.rate_denominator) * 1e9 / static_cast<double>(clock.rate_numerator)) {}

    /// The time of the spike, rounded to the nearest nanosecond.
    std::int64_t nanoseconds(const Spike& s) const {
        std::int64_t cycles = (s.step - 1) / samples_per_cycle_, rest = (s.step - 1) % samples_per_cycle_;
        if (rest < 0) rest += samples_per_cycle_, --cycles;
        return start_ns_ + cycles * cycle_ns_ +
               static_cast<std::int64_t>(std::floor((static_cast<double>(rest) + s.offset) * sample_ns_ + 0.5));
    }
};

}  // namespace corpuscle
