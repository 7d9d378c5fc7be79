#pragma once
// Blocks of the receptors that are calibrated to nerves: two low-passes in series, and compression.

#include "model/current.hpp"

namespace corpuscle {

/// Two equal low-passes in series. Each treats its input as a straight line between samples; the output of a low-pass is its input minus the
/// high-pass of the same cutoff frequency.
template <class T>
struct TwoLowPasses {
    /// Values at the last sample: input of each low-pass, and its input minus its output.
    struct State {
        T in_1, x_1, in_2, x_2;
    };
    HighPass<T> high;  // of each

    /// The state that an input has reached which was always the same.
    static State start(T in) { return {in, T(0.0), in, T(0.0)}; }
    static T output(const State& s) { return s.in_2 - s.x_2; }
    void step(State& s, T in) const {
        s.x_1 = high.next(s.x_1, in - s.in_1), s.in_1 = in;
        const T between = in - s.x_1;
        s.x_2 = high.next(s.x_2, between - s.in_2), s.in_2 = between;
    }
    /// Sets small differences to zero, so that a constant input leads to a constant state.
    static void flush_decayed(State& s) {
        s.x_1 = snap_to_level(s.x_1, negligible_force);
        s.in_2 = s.in_1 - s.x_1;
        s.x_2 = snap_to_level(s.x_2, negligible_force);
    }
};

/// Compression of a filtered force y (N) to a current: I = I_0 asinh(y / F_0). It is linear well below F_0 and logarithmic well above, as a
/// pair of transistors gives it. Negative y is cut off.
template <class T>
class Compression {
    static constexpr double series_limit = 0.01;  // the rest of the series is below 4e-18 of x
    T I_0, per_newton;                            // A; 1 / F_0, 1/N

public:
    Compression(T I_0, T F_0) : I_0(I_0), per_newton(T(1.0) / F_0) {}
    T operator()(T y) const {
        const T x = num::positive_part(y) * per_newton, square = x * x;
        // The Taylor series. Most afferents of a skin are far below F_0 at most times; if all lanes are, the logarithm is not computed.
        const T series = x + x * square * (T(-1.0 / 6) + square * (T(3.0 / 40) + square * T(-15.0 / 336)));
        const auto is_large = x > T(series_limit);
        if (!num::any(is_large)) return I_0 * series;
        return I_0 * num::select(is_large, num::log(x + num::sqrt(square + T(1.0))), series);
    }
};

}  // namespace corpuscle
