#pragma once
// Causal filters for badly logged force: what they give depends on what went before alone, so a stream and a file agree.

#include "signal/clock.hpp"
#include "signal/error.hpp"

namespace corpuscle {

/// A second-order section, y = b0 x + b1 x' + b2 x'' - a1 y' - a2 y'', in transposed direct form II.
/// It begins as if its first sample had always been there.
class Biquad {
    double b0_, b1_, b2_, a1_, a2_;
    double s1_ = 0, s2_ = 0;
    bool begun_ = false;

    Biquad(double b0, double b1, double b2, double a0, double a1, double a2)
        : b0_(b0 / a0), b1_(b1 / a0), b2_(b2 / a0), a1_(a1 / a0), a2_(a2 / a0) {}

public:
    /// Takes out one frequency (Hz) and what lies within 2 Hz of it (-3 dB), or within a quarter of it if that is less.
    static Result<Biquad> notch(double f, const Clock&);
    /// Butterworth of second order, -3 dB at f (Hz).
    static Result<Biquad> lowpass(double f, const Clock&);

    double next(double x) {
        if (!begun_) {  // at rest under x: y = x, for both kinds pass 0 Hz as it is
            begun_ = true;
            s2_ = (b2_ - a2_) * x;
            s1_ = (b1_ - a1_) * x + s2_;
        }
        const double y = b0_ * x + s1_;
        s1_ = flushed(b1_ * x - a1_ * y + s2_);
        s2_ = flushed(b2_ * x - a2_ * y);
        return y;
    }

private:
    /// Long after a touch the states would fade through numbers that processors are slow with.
    static double flushed(double s) { return s > -1e-200 && s < 1e-200 ? 0 : s; }
};

}  // namespace corpuscle
