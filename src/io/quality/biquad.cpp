#include "io/quality/biquad.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "core/number/elementary.hpp"

namespace corpuscle {
namespace {

/// Returns an error if f is not between 0 and half the sample rate. `option` is the option that gives f, for the message.
Result<void> check_frequency(double f, const Clock& clock, const char* option) {
    if (f > 0 && f < clock.rate() / 2) return {};
    return bad_input(
        fmt::format("{} {:g}Hz: at a sample rate of {:g} Hz it must be between 0 and {:g} Hz", option, f, clock.rate(), clock.rate() / 2));
}

}  // namespace

// Both filters use the bilinear transform, prewarped so that f is exact. Source: R. Bristow-Johnson, "Cookbook formulae for audio EQ
// biquad filter coefficients". With the angular frequency w = 2 pi f / rate: alpha = sin(w) / (2 Q), c = -2 cos(w) for the notch, and
// c = cos(w) for the low-pass filter.

Result<Biquad> Biquad::notch(double f, const Clock& clock) {
    TRY(check_frequency(f, clock, "--notch"));
    const double turns = f / clock.rate(), Q = f / std::min(4.0, f / 2);  // Q: f over the -3 dB bandwidth
    const double alpha = num::sin_turns(turns) / (2 * Q), c = -2 * num::cos_turns(turns);
    return Biquad(1, c, 1, 1 + alpha, c, 1 - alpha);
}

Result<Biquad> Biquad::lowpass(double f, const Clock& clock) {
    TRY(check_frequency(f, clock, "--lowpass"));
    const double turns = f / clock.rate(), c = num::cos_turns(turns), alpha = num::sin_turns(turns) * 0.70710678118654752;  // Q = sqrt(1/2)
    return Biquad((1 - c) / 2, 1 - c, (1 - c) / 2, 1 + alpha, -2 * c, 1 - alpha);
}

}  // namespace corpuscle
