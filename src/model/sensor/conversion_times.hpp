#pragma once
// The times of an analog-to-digital converter's conversions, in samples of a source with another rate. They are computed with integers, so
// that no error accumulates.

#include <cmath>
#include <cstdint>

#include "signal/afferent.hpp"
#include "signal/clock.hpp"

namespace corpuscle {

/// Source samples per conversion, as the fraction A / B. Conversion j of channel c of N takes place (j + c/N) A / B samples after sample 0.
class ConversionTimes {
    std::int64_t quotient_, remainder_, denominator_, channels_;  // A / B and A mod B; B; N

public:
    /// A position between samples: `remainder` / (B N) of the way from sample `step` to the next.
    struct SamplePosition {
        std::int64_t step = 0, remainder = 0;
        bool is_after(std::int64_t sample) const { return step > sample || (step == sample && remainder > 0); }
    };

    /// The ratio of the rates is replaced by the simplest fraction within 1e-12 of it.
    ConversionTimes(double source_rate, double f_s, std::uint32_t channels) : channels_(channels) {
        const double ratio = source_rate / f_s, above_one = ratio >= 1 ? ratio : 1 / ratio;
        const auto fraction = make_clock(above_one);  // fails above 1e12, where the nearest integer is accurate enough
        const std::int64_t numerator = fraction ? fraction->rate_numerator : static_cast<std::int64_t>(above_one),
                           denominator = fraction ? fraction->rate_denominator : 1;
        const std::int64_t a = ratio >= 1 ? numerator : denominator, b = ratio >= 1 ? denominator : numerator;
        quotient_ = a / b, remainder_ = a % b, denominator_ = b;
    }

    /// The number of parts that a sample interval is divided into.
    std::int64_t parts_per_sample() const { return denominator_ * channels_; }
    SamplePosition first(std::uint32_t channel) const {
        const std::int64_t c = channel, ahead = c * quotient_;
        const std::int64_t rest = c * remainder_ + (ahead % channels_) * denominator_;
        return {ahead / channels_ + rest / parts_per_sample(), rest % parts_per_sample()};
    }
    void advance(SamplePosition& p) const {
        p.step += quotient_, p.remainder += remainder_ * channels_;
        if (p.remainder >= parts_per_sample()) p.remainder -= parts_per_sample(), ++p.step;
    }
};

}  // namespace corpuscle
