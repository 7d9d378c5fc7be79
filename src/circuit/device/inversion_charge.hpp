#pragma once
// Normalized inversion charge density q at one end of a channel from the normalized voltage x there: solves q + ln q = x in constant time,
// without branches.

#include "core/number/elementary.hpp"

namespace corpuscle::circuit {

/// Natural logarithm of a normal x = 2^k m > 0, as accurate as num::log and faster. With s = (m - 1) / (m + 1) and z = s^2,
/// log m = 2 artanh s = 2 s + s z (2/3 + 2/5 z ...). The minimax polynomial for |s| <= 0.172 (error 3e-16) replaces the series in brackets.
/// Its terms are summed in pairs.
template <class T>
[[gnu::always_inline]] inline T fast_log(T x) {
    T m = num::mantissa(x), k = num::exponent(x);
    const auto high = m > T(1.4142135623730951);
    m = num::select(high, m * T(0.5), m);
    k = num::select(high, k + T(1.0), k);
    const T s = (m - T(1.0)) / (m + T(1.0)), z = s * s, zz = z * z;
    const T p =
        ((T(0.6666666666666669729) + T(0.3999999999989845231) * z) + (T(0.2857142862639635549) + T(0.2222221107325369215) * z) * zz) +
        ((T(0.1818289319116462142) + T(0.1533159782667055724) * z) + T(0.1461786234999955919) * zz) * (zz * zz);
    return k * T(6.93147180369123816490e-01) + (T(2.0) * s + (s * z * p + k * T(1.90821492927058770002e-10)));
}

/// A Dual is a value v with its derivative d.
inline num::Dual fast_log(num::Dual x) { return {fast_log(x.v), x.d / x.v}; }

num::Dual inversion_charge(num::Dual x);  // declared before the templates, so that they find it

namespace detail {

/// e^x with a relative error below 8e-5.
template <class T>
[[gnu::always_inline]] inline T rough_exp(T x) {
    const T y = x * T(1.4426950408889634), k = num::nearest(y), f = y - k;
    return num::times_power_of_two(T(0.99992807) + f * (T(0.69326099) + f * (T(0.24261112) + f * T(0.05517166))), k);
}

/// ln x with an absolute error below 5e-4, for a normal x > 0.
template <class T>
[[gnu::always_inline]] inline T rough_log(T x) {
    const T m = num::mantissa(x);
    return num::exponent(x) * T(0.6931471805599453) + (T(-1.49277583) + m * (T(2.11263167) + m * (T(-0.72910377) + m * T(0.10968954))));
}

/// First approximation of q, with a relative error of about 3e-4: a series in e^x for x < -2.5, one in ln x for x > 6, a polynomial
/// between.
template <class T>
[[gnu::always_inline]] inline T inversion_seed(T x) {
    const auto far = x > T(6.0);
    const T y = num::max(x, T(6.0)), L = rough_log(y);
    const T E = rough_exp(num::select(far, -L, num::max(num::min(x, T(-2.5)), T(-num::exp_limit<T>))));  // e^x for x < -2.5, 1/x for x > 6
    const T low = E * (T(1.0) - E * (T(1.0) - E * (T(1.5) - E * T(8.0 / 3))));
    const T high = y - L + L * E * (T(1.0) + E * (T(0.5) * L - T(1.0)));

    const T s = (num::min(num::max(x, T(-2.5)), T(6.0)) - T(1.75)) * T(1 / 4.25), ss = s * s;
    const T even = T(1.408131135) + ss * (T(0.9115124333) + ss * (T(0.03677439334) + ss * T(-0.07109053874)));
    const T odd = T(2.489977625) + ss * (T(-0.4564352694) + ss * (T(0.2518980967) + ss * T(-0.07615062164)));
    const T middle = even + s * odd;

    return num::select(x < T(-2.5), low, num::select(far, high, middle));
}

}  // namespace detail

/// Solves q + ln q = x for q: inversion_seed(), then one fourth-order step of Fritsch, Shafer and Crowley (algorithm 443, Comm. ACM 16,
/// 1973). Relative error below 1e-13 for |x| <= 700, mostly from the rounding of x. Returns e^-700 for x < -700. NaN in, NaN out.
template <class T>
[[gnu::always_inline]] inline T inversion_charge(T x) {
    const T q = detail::inversion_seed(x), r = num::max(T(-num::exp_limit<T>), x) - q - fast_log(q);
    const T p = T(1.0) + q, a = T(2.0) * p * (p + r * T(2.0 / 3));
    return q + q * r * (a - r) / (p * (a - T(2.0) * r));
}

/// With the derivative dq/dx = q / (1 + q).
inline num::Dual inversion_charge(num::Dual x) {
    const double q = inversion_charge(x.v);
    return {q, q / (1 + q) * x.d};
}

}  // namespace corpuscle::circuit
