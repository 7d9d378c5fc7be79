#pragma once

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

}  // namespace corpuscle::circuit
