#pragma once
// A number with its derivatives along N directions, for equations whose slopes along all directions are needed at once.

#include <array>

#include "core/number/elementary.hpp"

namespace corpuscle::num {

template <int N>
struct Gradient {
    double v = 0;                  // value
    std::array<double, N> d = {};  // its derivatives
    constexpr Gradient() = default;
    constexpr Gradient(double value) : v(value) {}
    /// The independent variable of a direction.
    static constexpr Gradient variable(double value, int direction) {
        Gradient x(value);
        x.d[static_cast<std::size_t>(direction)] = 1;
        return x;
    }
    /// The function with this value and, with respect to x, this slope.
    constexpr Gradient mapped(double value, double slope) const {
        Gradient out(value);
        for (std::size_t k = 0; k < N; ++k) out.d[k] = slope * d[k];
        return out;
    }
    friend constexpr Gradient operator-(const Gradient& a) { return a.mapped(-a.v, -1); }
    friend constexpr Gradient operator+(Gradient a, const Gradient& b) { return a += b; }
    friend constexpr Gradient operator-(Gradient a, const Gradient& b) { return a -= b; }
    friend constexpr Gradient operator*(const Gradient& a, const Gradient& b) {
        Gradient out(a.v * b.v);
        for (std::size_t k = 0; k < N; ++k) out.d[k] = a.d[k] * b.v + a.v * b.d[k];
        return out;
    }
    friend constexpr Gradient operator/(const Gradient& a, const Gradient& b) {
        Gradient out(a.v / b.v);
        const double inverse = 1 / b.v;
        for (std::size_t k = 0; k < N; ++k) out.d[k] = (a.d[k] - out.v * b.d[k]) * inverse;
        return out;
    }
    friend constexpr bool operator<(const Gradient& a, const Gradient& b) { return a.v < b.v; }
    friend constexpr bool operator>(const Gradient& a, const Gradient& b) { return a.v > b.v; }
    friend constexpr bool operator<=(const Gradient& a, const Gradient& b) { return a.v <= b.v; }
    friend constexpr bool operator>=(const Gradient& a, const Gradient& b) { return a.v >= b.v; }
    constexpr Gradient& operator+=(const Gradient& b) {
        v += b.v;
        for (std::size_t k = 0; k < N; ++k) d[k] += b.d[k];
        return *this;
    }
    constexpr Gradient& operator-=(const Gradient& b) {
        v -= b.v;
        for (std::size_t k = 0; k < N; ++k) d[k] -= b.d[k];
        return *this;
    }
};

template <int N>
Gradient<N> select(bool m, const Gradient<N>& yes, const Gradient<N>& no) {
    return m ? yes : no;
}
template <int N>
double value(const Gradient<N>& x) {
    return x.v;
}
template <int N>
Gradient<N> sqrt(const Gradient<N>& x) {
    const double root = std::sqrt(x.v);
    return x.mapped(root, 0.5 / root);
}
template <int N>
Gradient<N> exp(const Gradient<N>& x) {
    const double e = exp(x.v);
    return x.mapped(e, e);
}
template <int N>
Gradient<N> log(const Gradient<N>& x) {
    return x.mapped(log(x.v), 1 / x.v);
}

}  // namespace corpuscle::num
