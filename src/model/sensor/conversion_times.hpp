#pragma once
// The times of an analog-to-digital converter's conversions, as positions between the samples of its input (the source), which has another
// rate. They are computed with integers, so that no error accumulates.

#include <cmath>
#include <cstdint>

#include "core/afferent.hpp"
#include "core/clock.hpp"

namespace corpuscle {

/// Let A / B be the number of source samples per conversion, a fraction of integers. Conversion j (from 0) of channel c (from 0) of N takes
/// place (j + c/N) A / B samples after source sample 0.
class ConversionTimes {
    std::int64_t quotient_, remainder_, denominator_, channels_;  // floor(A / B), A mod B, B, N

public:
    /// A position among the source samples: `remainder` / (B N) of the way from sample `step` to the next one.
    struct SamplePosition {
        std::int64_t step = 0, remainder = 0;
        bool is_after(std::int64_t sample) const { return step > sample || (step == sample && remainder > 0); }
    };

    /// source_rate: samples per second; f_s: conversions per second. Their ratio is replaced by the simplest fraction that differs from it
    /// by at most 1e-12 of its value.
    ConversionTimes(double source_rate, double f_s, std::uint32_t channels) : channels_(channels) {
        const double ratio = source_rate / f_s, at_least_one = ratio >= 1 ? ratio : 1 / ratio;
        const auto fraction = make_clock(at_least_one);  // fails above 1e12, where the integer part is accurate enough
        const std::int64_t numerator = fraction ? fraction->rate_numerator : static_cast<std::int64_t>(at_least_one),
                           denominator = fraction ? fraction->rate_denominator : 1;
        const std::int64_t a = ratio >= 1 ? numerator : denominator, b = ratio >= 1 ? denominator : numerator;
        quotient_ = a / b, remainder_ = a % b, denominator_ = b;
    }

    /// The number of parts into which remainders divide an interval between samples: B N.
    std::int64_t parts_per_sample() const { return denominator_ * channels_; }
    /// The position of conversion 0 of a channel.
    SamplePosition first(std::uint32_t channel) const {
        const std::int64_t c = channel, c_quotient = c * quotient_;
        const std::int64_t rest = c * remainder_ + (c_quotient % channels_) * denominator_;  // in parts of 1 / (B N)
        return {c_quotient / channels_ + rest / parts_per_sample(), rest % parts_per_sample()};
    }
    /// Moves to the position of the same channel's next conversion.
    void advance(SamplePosition& p) const {
        p.step += quotient_, p.remainder += remainder_ * channels_;
        if (p.remainder >= parts_per_sample()) p.remainder -= parts_per_sample(), ++p.step;
    }
};

}  // namespace corpuscle
