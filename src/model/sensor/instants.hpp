#pragma once
// The times of conversions, counted in samples of a source of any other rate. Integers only, so that no error accumulates.

#include <cmath>
#include <cstdint>

#include "signal/afferent.hpp"
#include "signal/clock.hpp"

namespace corpuscle {

/// Source samples per conversion, as the fraction A / B. Conversion j of channel c of N takes place (j + c/N) A / B samples after sample 0.
class Instants {
    std::int64_t whole_, part_, base_, turns_;  // A / B and A mod B; B; N

public:
    /// A position between samples: `rest` / (B N) of the way from sample `step` to the next.
    struct Place {
        std::int64_t step = 0, rest = 0;
        bool after(std::int64_t sample) const { return step > sample || (step == sample && rest > 0); }
    };

    /// The ratio of the rates is replaced by the simplest fraction within 1e-12 of it.
    Instants(double source_rate, double f_s, std::uint32_t channels) : turns_(channels) {
        const double ratio = source_rate / f_s, above_one = ratio >= 1 ? ratio : 1 / ratio;
        const auto fraction = make_clock(above_one);  // fails above 1e12, where the nearest integer is accurate enough
        const std::int64_t numerator = fraction ? fraction->rate_numerator : static_cast<std::int64_t>(above_one),
                           denominator = fraction ? fraction->rate_denominator : 1;
        const std::int64_t a = ratio >= 1 ? numerator : denominator, b = ratio >= 1 ? denominator : numerator;
        whole_ = a / b, part_ = a % b, base_ = b;
    }

    /// The number of parts that a sample interval is divided into.
    std::int64_t parts() const { return base_ * turns_; }
    Place first(std::uint32_t channel) const {
        const std::int64_t c = channel, ahead = c * whole_;
        const std::int64_t rest = c * part_ + (ahead % turns_) * base_;
        return {ahead / turns_ + rest / parts(), rest % parts()};
    }
    void advance(Place& p) const {
        p.step += whole_, p.rest += part_ * turns_;
        if (p.rest >= parts()) p.rest -= parts(), ++p.step;
    }
};

}  // namespace corpuscle
