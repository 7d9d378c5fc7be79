#pragma once
// Causal filters for recordings. The output depends only on the current and earlier samples, so a stream and a file give the same result.

#include "core/clock.hpp"

namespace corpuscle {

/// A second-order section, y[k] = b0 x[k] + b1 x[k-1] + b2 x[k-2] - a1 y[k-1] - a2 y[k-2], in transposed direct form II. It begins in the
/// steady state of a constant input equal to the first sample.
class Biquad {
    double b0_, b1_, b2_, a1_, a2_;
    double s1_ = 0, s2_ = 0;   // state
    bool is_started_ = false;  // true after the first sample

    Biquad(double b0, double b1, double b2, double a0, double a1, double a2)
        : b0_(b0 / a0), b1_(b1 / a0), b2_(b2 / a0), a1_(a1 / a0), a2_(a2 / a0) {}

public:
    // A frequency f that is not between 0 and half the sample rate is an error.

    /// A filter that removes the frequency f (Hz). The -3 dB points are at f +- 2 Hz, or at f +- f/4 if f is below 8 Hz.
    static Result<Biquad> notch(double f, const Clock&);
    /// A second-order Butterworth low-pass filter, -3 dB at f (Hz).
    static Result<Biquad> lowpass(double f, const Clock&);

    /// The output for the next sample x.
    double next(double x) {
        if (!is_started_) {  // steady state for x: y = x, because both filters have unit gain at 0 Hz
            is_started_ = true;
            s2_ = (b2_ - a2_) * x;
            s1_ = (b1_ - a1_) * x + s2_;
        }
        const double y = b0_ * x + s1_;
        s1_ = flush_tiny(b1_ * x - a1_ * y + s2_);
        s2_ = flush_tiny(b2_ * x - a2_ * y);
        return y;
    }

private:
    /// Flushes tiny values to zero. Otherwise the states would become denormal long after a touch, which is slow.
    static double flush_tiny(double s) { return s > -1e-200 && s < 1e-200 ? 0 : s; }
};

}  // namespace corpuscle
