#pragma once
// exp, log, sin and cos, computed with + - * / and bit operations only. The results are therefore identical on every processor,
// instruction set and lane width, unlike those of the C library. The error is at most a few units in the last place.

#include <initializer_list>

#include "core/number/number.hpp"

namespace corpuscle::num {

// Overloads for dual numbers, defined at the end. They are declared first, so that calls with a Dual do not select the templates.
Dual exp(Dual x);
Dual log(Dual x);
Dual sin_turns(Dual x);
Dual cos_turns(Dual x);

/// e^x, with x limited to +- exp_limit (700 for double, 87 for float).
template <class T>
T exp(T x) {
    x = num::min(num::max(x, T(-exp_limit<T>)), T(exp_limit<T>));
    const T k = num::nearest(x * T(1.4426950408889634));  // x / ln 2
    // r = x - k ln 2. ln 2 is the sum of two constants, so that k times the first one is exact.
    const T r = (x - k * T(6.93147180369123816490e-01)) - k * T(1.90821492927058770002e-10);
    // Taylor series to r^13; |r| <= 0.347, so the remainder is below 4e-18. Estrin's scheme gives short dependency chains.
    const T r2 = r * r, r4 = r2 * r2, r8 = r4 * r4;
    const auto pair = [r](double low, double high) { return T(1.0 / low) + T(1.0 / high) * r; };
    const T low = pair(2.0, 6.0) + pair(24.0, 120.0) * r2, middle = pair(720.0, 5040.0) + pair(40320.0, 362880.0) * r2;
    const T high = pair(3628800.0, 39916800.0) + pair(479001600.0, 6227020800.0) * r2;
    const T p = T(1.0) + (r + r2 * (low + middle * r4 + high * r8));
    return num::times_power_of_two(p, k);
}

/// Natural logarithm of a normal x > 0. A call would save and restore all vector registers of a loop, so the function is always inlined.
template <class T>
[[gnu::always_inline]] inline T log(T x) {
    T m = num::mantissa(x), k = num::exponent(x);
    const auto high = m > T(1.4142135623730951);  // above sqrt 2: halve m, so that it is in (0.7071, 1.4142]
    m = num::select(high, m * T(0.5), m);
    k = num::select(high, k + T(1.0), k);
    const T s = (m - T(1.0)) / (m + T(1.0)), z = s * s;  // log m = 2 artanh s, |s| <= 0.172
    T p = T(1.0 / 21);
    for (const double n : {19.0, 17.0, 15.0, 13.0, 11.0, 9.0, 7.0, 5.0, 3.0}) p = p * z + T(1.0 / n);
    return k * T(6.93147180369123816490e-01) + (T(2.0) * s + (T(2.0) * s * z * p + k * T(1.90821492927058770002e-10)));
}

namespace detail {
template <class T>
T sin_taylor(T y) {  // |y| <= pi/4
    const T z = y * y;
    T p = T(1.0 / 355687428096000.0);
    for (const double f : {-1307674368000.0, 6227020800.0, -39916800.0, 362880.0, -5040.0, 120.0, -6.0}) p = p * z + T(1.0 / f);
    return y + y * z * p;
}
template <class T>
T cos_taylor(T y) {  // |y| <= pi/4
    const T z = y * y;
    T p = T(-1.0 / 6402373705728000.0);
    for (const double f : {20922789888000.0, -87178291200.0, 479001600.0, -3628800.0, 40320.0, -720.0, 24.0}) p = p * z + T(1.0 / f);
    return (T(1.0) - T(0.5) * z) + z * z * p;
}
}  // namespace detail

// Signs are changed by multiplying by -1, not by negation: xsimd can negate by 0 - x, which loses the sign of a zero (see simd_lanes.hpp).

/// sin(2 pi turns) for |turns| < 2^49; exact at quarter turns.
template <class T>
T sin_turns(T turns) {
    const T quarter = num::nearest(turns * T(4.0));
    const T y = (turns - quarter * T(0.25)) * T(6.283185307179586);  // angle from the nearest quarter turn, radians
    const T q = quarter - T(4.0) * num::nearest(quarter * T(0.25));  // that quarter turn modulo 4: -2 ... 2
    const T s = detail::sin_taylor(y), c = detail::cos_taylor(y);
    const T odd = num::select(q > T(0.0), c, T(-1.0) * c), even = num::select(num::abs(q) > T(1.5), T(-1.0) * s, s);
    return num::select(num::abs(num::abs(q) - T(1.0)) < T(0.5), odd, even);
}

/// cos(2 pi turns), computed like sin_turns().
template <class T>
T cos_turns(T turns) {
    const T quarter = num::nearest(turns * T(4.0));
    const T y = (turns - quarter * T(0.25)) * T(6.283185307179586);
    const T q = quarter - T(4.0) * num::nearest(quarter * T(0.25));
    const T s = detail::sin_taylor(y), c = detail::cos_taylor(y);
    const T odd = num::select(q > T(0.0), T(-1.0) * s, s), even = num::select(num::abs(q) > T(1.5), T(-1.0) * c, c);
    return num::select(num::abs(num::abs(q) - T(1.0)) < T(0.5), odd, even);
}

/// (e^x - 1) / x without loss of digits for small x; 1 at x = 0. `exp_x` must be exp(x).
template <class T>
T exprel(T x, T exp_x) {
    // Taylor series to x^6. Below series_limit the remainder is at most 3e-19 for double (|x| < 0.01), and 6e-9 for float (|x| < 0.3).
    T series = T(1.0 / 5040);
    for (const double f : {720.0, 120.0, 24.0, 6.0, 2.0, 1.0}) series = series * x + T(1.0 / f);
    const auto small = num::abs(x) < T(series_limit<T>);
    return num::select(small, series, (exp_x - T(1.0)) / num::select(small, T(1.0), x));
}
template <class T>
T exprel(T x) {
    return exprel(x, num::exp(x));
}

// Functions of dual numbers: value and derivative. The value is identical to the result for a double.
inline Dual exp(Dual x) {
    const double e = exp(x.v);
    return {e, e * x.d};
}
inline Dual log(Dual x) { return {log(x.v), x.d / x.v}; }
inline Dual nearest(Dual x) { return {nearest(x.v), 0.0}; }
inline Dual sin_turns(Dual x) { return {sin_turns(x.v), 6.283185307179586 * cos_turns(x.v) * x.d}; }
inline Dual cos_turns(Dual x) { return {cos_turns(x.v), -6.283185307179586 * sin_turns(x.v) * x.d}; }

}  // namespace corpuscle::num
