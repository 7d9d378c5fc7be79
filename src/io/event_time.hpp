#pragma once
// Times of spikes as whole nanoseconds, the same however long a stream has run.

#include <cmath>

#include "signal/spike.hpp"

namespace corpuscle {

/// `seconds` times the rate are `per` samples: whole cycles of those are counted in whole numbers, and only the rest, less than one cycle,
/// is a double. So a spike after a year is as sharp as the first.
class EventTime {
    std::int64_t per_, cycle_, start_;  // samples; ns; ns
    double step_;                       // ns

public:
    explicit EventTime(const Clock& clock)
        : per_(clock.per), cycle_(clock.seconds * 1'000'000'000), start_(std::llround(clock.t0 * 1e9)),
          step_(static_cast<double>(clock.seconds) * 1e9 / static_cast<double>(clock.per)) {}

    /// Rounded to the nearest.
    std::int64_t nanoseconds(const Spike& s) const {
        std::int64_t cycles = (s.step - 1) / per_, rest = (s.step - 1) % per_;
        if (rest < 0) rest += per_, --cycles;
        return start_ + cycles * cycle_ + static_cast<std::int64_t>(std::floor((static_cast<double>(rest) + s.offset) * step_ + 0.5));
    }
};

}  // namespace corpuscle
