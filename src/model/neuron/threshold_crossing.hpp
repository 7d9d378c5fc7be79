#pragma once
// Helpers of the integrate-and-fire neurons for events within one step. x is the time within the step: 0 at its beginning, which is the
// previous sample, and 1 at its end.

#include <type_traits>
#include <utility>

#include "core/number/elementary.hpp"

namespace corpuscle {

/// The largest number of spikes of one neuron in one step. A step that would have more is truncated; such steps are counted and reported.
inline constexpr int max_spikes_per_step = 64;

/// A parabola without a constant term: q(x) = a x + b x^2 / 2.
template <class T>
struct Parabola {
    T a, b;
    T at(T x) const { return x * (a + T(0.5) * b * x); }
    /// The minimum of q on [x0, 1].
    T min_from(T x0) const {
        T minimum = num::min(at(x0), at(T(1.0)));
        const num::Mask<T> has_minimum = (a + b * x0 < T(0.0)) & (a + b > T(0.0));
        if (num::any(has_minimum)) minimum = num::select(has_minimum, T(-0.5) * a * a / num::select(has_minimum, b, T(1.0)), minimum);
        return minimum;
    }
    /// The x at which q rises through the value c. A discriminant that rounding has made negative is set to zero. Of the two equivalent
    /// formulas for the root, the one without cancellation is used.
    T rising_crossing(T c) const {
        const T root = num::sqrt(num::positive_part(a * a + T(2.0) * b * c));
        const auto starts_rising = a > T(0.0);
        const T numerator = num::select(starts_rising, T(2.0) * c, root - a), denominator = num::select(starts_rising, a + root, b);
        return numerator / denominator;
    }
};

/// The offset of a spike within its step: x, limited to (0, 1] and to times not before x0, the earliest possible time.
template <class T>
T spike_offset(T x, T x0) {
    return num::min(num::max(x, num::max(x0, T(0x1p-52))), T(1.0));
}

/// True if T has no derivatives, so that equal values are equal numbers: a number or lanes.
template <class T>
inline constexpr bool is_plain = std::is_floating_point_v<T> || requires { T::size; };

/// The root of a function that rises through 0 between low and high, by Newton's method, with bisection where a step would leave the
/// bracket. The number of passes is fixed, so that lanes and scalars compute the same. The passes end early if a pass does not change x on
/// the lanes of `needed`, because then no further pass does. Other lanes have no meaning. f(x) returns {value, slope}.
template <class T, class F>
T rising_root(F f, T low, T high, num::Mask<T> needed) {
    T x = T(0.5) * (low + high);
    for (int pass = 0; pass < 12; ++pass) {
        const auto [v, slope] = f(x);
        high = num::select(v > T(0.0), x, high);
        low = num::select(v > T(0.0), low, x);
        const T newton = x - v / slope;
        const T before = std::exchange(x, num::select((newton >= low) & (newton <= high), newton, T(0.5) * (low + high)));
        if constexpr (is_plain<T>)
            if (!num::any(needed & (x != before))) break;
    }
    return x;
}

}  // namespace corpuscle
