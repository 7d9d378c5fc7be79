#pragma once
// What the integrate-and-fire neurons share: the inside of one step, x from 0 at the last sample to 1 at this one.

#include "signal/elementary.hpp"

namespace corpuscle {

/// Spikes of one neuron in one step at the most; a step cut short by it is told and counted.
inline constexpr int spikes_a_step = 64;

/// A path with straight slope, q(x) = a x + b x^2 / 2, up to its own constant.
template <class T>
struct Parabola {
    T a, b;
    T at(T x) const { return x * (a + T(0.5) * b * x); }
    /// The least of q on [x0, 1].
    T least_after(T x0) const {
        T least = num::min(at(x0), at(T(1.0)));
        const num::Mask<T> turns = (a + b * x0 < T(0.0)) & (a + b > T(0.0));
        if (num::any(turns)) least = num::select(turns, T(-0.5) * a * a / num::select(turns, b, T(1.0)), least);
        return least;
    }
    /// Where q rises through c, the discriminant kept from rounding below 0.
    T rises_through(T c) const {
        const T root = num::sqrt(num::positive(a * a + T(2.0) * b * c));
        const auto straight = a > T(0.0);
        const T numerator = num::select(straight, T(2.0) * c, root - a), denominator = num::select(straight, a + root, b);
        return numerator / denominator;
    }
};

/// An offset as a spike carries it: in (0, 1], not before x0.
template <class T>
T offset_from(T x, T x0) {
    return num::min(num::max(x, num::max(x0, T(0x1p-52))), T(1.0));
}

/// The root of a function that rises through 0 between low and high: Newton's steps, halving where they would leave the
/// bracket; always the same number of passes, so that lanes and scalars do the same. f(x) gives {value, slope}.
template <class T, class F>
T rising_root(F f, T low, T high) {
    T x = T(0.5) * (low + high);
    for (int pass = 0; pass < 12; ++pass) {
        const auto [v, slope] = f(x);
        high = num::select(v > T(0.0), x, high);
        low = num::select(v > T(0.0), low, x);
        const T newton = x - v / slope;
        x = num::select((newton >= low) & (newton <= high), newton, T(0.5) * (low + high));
    }
    return x;
}

}  // namespace corpuscle
