#pragma once
// The kinds of number that a model's text runs on, and the few operations it may use on them.
// A model writes num::select, num::any, num::exp ..., always qualified: unqualified names are ambiguous on
// SIMD batches. A further kind of number joins by adding its overloads here, before any model is included.

#include <bit>
#include <cmath>
#include <cstdint>

namespace corpuscle::num {

// ---- double ----

template <class T>
struct MaskOf {
    using type = bool;
};
/// e^x is not followed beyond +-this: nothing needs more, and no infinity can arise.
template <class T>
inline constexpr double exp_reach = 700;
/// Below this a difference e^x - 1 loses digits, and a short series does not.
template <class T>
inline constexpr double series_reach = 0.01;
/// What a comparison of two T gives: bool, or a mask of lanes.
template <class T>
using Mask = typename MaskOf<T>::type;

}  // namespace corpuscle::num

#ifdef CORPUSCLE_ISA  // in a file compiled for one instruction set
#include "signal/lanes.hpp"
#endif

namespace corpuscle::num {

inline bool any(bool m) { return m; }
inline double select(bool m, double yes, double no) { return m ? yes : no; }
inline double sqrt(double x) { return std::sqrt(x); }  // IEEE: correctly rounded everywhere
inline double value(double x) { return x; }

/// Nearest integer, ties to even, for |x| < 2^51. The sum rounds; no rounding instruction is needed.
inline double nearest(double x) {
    constexpr double big = 6755399441055744.0;  // 1.5 * 2^52
    return (x + big) - big;
}
/// x 2^k for an integral k with a normal result.
inline double times_power_of_two(double x, double k) { return x * std::bit_cast<double>((static_cast<std::int64_t>(k) + 1023) << 52); }
/// For a normal x > 0: the mantissa in [1, 2), and the power of two that goes with it.
inline double mantissa(double x) {
    return std::bit_cast<double>((std::bit_cast<std::uint64_t>(x) & 0x000fffffffffffffU) | 0x3ff0000000000000U);
}
inline double exponent(double x) { return static_cast<double>(static_cast<std::int64_t>(std::bit_cast<std::uint64_t>(x) >> 52) - 1023); }

// ---- dual: a value and its slope along one chosen direction ----

struct Dual {
    double v = 0, d = 0;
    constexpr Dual() = default;
    constexpr Dual(double value, double slope = 0) : v(value), d(slope) {}
    friend constexpr Dual operator+(Dual a, Dual b) { return {a.v + b.v, a.d + b.d}; }
    friend constexpr Dual operator-(Dual a, Dual b) { return {a.v - b.v, a.d - b.d}; }
    friend constexpr Dual operator-(Dual a) { return {-a.v, -a.d}; }
    friend constexpr Dual operator*(Dual a, Dual b) { return {a.v * b.v, a.d * b.v + a.v * b.d}; }
    friend constexpr Dual operator/(Dual a, Dual b) { return {a.v / b.v, (a.d - a.v / b.v * b.d) / b.v}; }
    friend constexpr bool operator<(Dual a, Dual b) { return a.v < b.v; }
    friend constexpr bool operator>(Dual a, Dual b) { return a.v > b.v; }
    friend constexpr bool operator<=(Dual a, Dual b) { return a.v <= b.v; }
    friend constexpr bool operator>=(Dual a, Dual b) { return a.v >= b.v; }
    Dual& operator+=(Dual b) { return *this = *this + b; }
    Dual& operator-=(Dual b) { return *this = *this - b; }
};

inline Dual select(bool m, Dual yes, Dual no) { return m ? yes : no; }
inline Dual sqrt(Dual x) {
    const double r = std::sqrt(x.v);
    return {r, x.d / (2 * r)};
}
inline double value(Dual x) { return x.v; }

/// No lane.
template <class T>
Mask<T> none() {
    return T(0.0) > T(0.0);
}

// ---- for every kind ----

template <class T>
T max(T a, T b) {
    return num::select(a > b, a, b);
}
template <class T>
T min(T a, T b) {
    return num::select(a < b, a, b);
}
template <class T>
T abs(T a) {
    return num::select(a < T(0.0), -a, a);
}
/// max{x, 0}, the thesis's rectifier (eq. 4).
template <class T>
T positive(T x) {
    return num::max(x, T(0.0));
}

}  // namespace corpuscle::num
