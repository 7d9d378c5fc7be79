#pragma once
// The number types that a model's equations run on, and the few operations that they may use.
// A model writes num::select, num::any, num::exp ..., always qualified: unqualified names are ambiguous on
// SIMD batches. To add a number type, add its overloads here, before any model is included.

#include <bit>
#include <cmath>
#include <cstdint>

namespace corpuscle::num {

// ---- double ----

template <class T>
struct MaskOf {
    using type = bool;
};
/// exp() limits its argument to +- this value, so that it never returns infinity.
template <class T>
inline constexpr double exp_limit = 700;
/// For |x| below this value exprel() uses a short series, because e^x - 1 would lose digits.
template <class T>
inline constexpr double series_limit = 0.01;
/// The type of a comparison of two T: bool, or a mask of lanes.
template <class T>
using Mask = typename MaskOf<T>::type;

}  // namespace corpuscle::num

#ifdef CORPUSCLE_ISA  // in a file compiled for one instruction set
#include "signal/simd_lanes.hpp"
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
/// mantissa() and exponent() split a normal x > 0 into a factor in [1, 2) and a power of two.
inline double mantissa(double x) {
    return std::bit_cast<double>((std::bit_cast<std::uint64_t>(x) & 0x000fffffffffffffU) | 0x3ff0000000000000U);
}
inline double exponent(double x) { return static_cast<double>(static_cast<std::int64_t>(std::bit_cast<std::uint64_t>(x) >> 52) - 1023); }

// ---- dual number: a value and its derivative along one direction ----

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

/// A mask with no lane set.
template <class T>
Mask<T> empty_mask() {
    return T(0.0) > T(0.0);
}

// ---- every number type ----

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
/// max{x, 0}, the rectifier of the thesis (eq. 4).
template <class T>
T positive_part(T x) {
    return num::max(x, T(0.0));
}

}  // namespace corpuscle::num
