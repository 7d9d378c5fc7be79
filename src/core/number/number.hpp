#pragma once
// The number types with which the equations of a model can be computed (double, SIMD lanes, dual numbers), and the operations that the
// equations may use. A model always writes num::select, num::any, num::exp ... with the namespace, because the names alone are ambiguous
// for SIMD batches. To add a number type, add its overloads here: they must be declared before the models that use them.

#include <bit>
#include <cmath>
#include <cstdint>

namespace corpuscle::num {

/// exp() in elementary.hpp limits its argument to +- this value, so that it never returns infinity. The values here are those for double;
/// simd_lanes.hpp has those for float.
template <class T>
inline constexpr double exp_limit = 700;
/// For |x| below this value exprel() in elementary.hpp uses a short series, because e^x - 1 would lose digits.
template <class T>
inline constexpr double series_limit = 0.01;

template <class T>
struct MaskOf {
    using type = bool;
};
/// The type of a comparison of two T: bool for one number, a mask with one bit for each lane for lanes.
template <class T>
using Mask = typename MaskOf<T>::type;

}  // namespace corpuscle::num

#ifdef CORPUSCLE_ISA  // defined in the files that are compiled once for each instruction set
#include "core/number/simd_lanes.hpp"
#endif

namespace corpuscle::num {

// ---- double ----

inline bool any(bool m) { return m; }  // of lanes: true if any lane of the mask is set
inline double select(bool m, double yes, double no) { return m ? yes : no; }
inline double sqrt(double x) { return std::sqrt(x); }  // the same on every machine: IEEE 754 requires correct rounding
inline double value(double x) { return x; }            // of a dual number: the value without the derivative

/// Nearest integer, ties to even, for |x| < 2^51. Adding `big` rounds, because doubles of this size are integers.
inline double nearest(double x) {
    constexpr double big = 6755399441055744.0;  // 1.5 * 2^52
    return (x + big) - big;
}
/// x 2^k for an integer k. 2^k and the result must be normal numbers.
inline double times_power_of_two(double x, double k) { return x * std::bit_cast<double>((static_cast<std::int64_t>(k) + 1023) << 52); }
/// mantissa() and exponent() split a normal x > 0 into a factor in [1, 2) and a power of two.
inline double mantissa(double x) {
    return std::bit_cast<double>((std::bit_cast<std::uint64_t>(x) & 0x000fffffffffffffU) | 0x3ff0000000000000U);
}
inline double exponent(double x) { return static_cast<double>(static_cast<std::int64_t>(std::bit_cast<std::uint64_t>(x) >> 52) - 1023); }

// ---- dual number: a value and its derivative along one direction ----

struct Dual {
    double v = 0, d = 0;  // value and derivative
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

// ---- a value with several derivatives: gradient.hpp. Declared here, so that the templates below find it ----

template <int N>
struct Gradient;
template <int N>
Gradient<N> select(bool m, const Gradient<N>& yes, const Gradient<N>& no);

/// The mask in which no lane is set; false for one number.
template <class T>
Mask<T> empty_mask() {
    return T(0.0) > T(0.0);
}

// ---- all number types ----

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
/// max(x, 0), the rectifier of the thesis (eq. 4).
template <class T>
T positive_part(T x) {
    return num::max(x, T(0.0));
}

}  // namespace corpuscle::num
