#pragma once
// Finds the time at which a function of time crosses zero upwards.

#include <algorithm>
#include <cmath>
#include <optional>

namespace corpuscle::circuit {

/// Finds the crossing by bisection, and returns a time at which f > 0. Returns nothing unless f(from) <= 0 and f(to) > 0.
template <class Function>
std::optional<double> bisect_crossing(double from, double to, const Function& f) {
    if (!(f(from) <= 0 && f(to) > 0)) return {};
    for (int k = 0; k < 50; ++k) {
        const double half = from + (to - from) / 2;
        f(half) > 0 ? to = half : from = half;
    }
    return to;
}

/// The same with known values at both ends, f_from and f_to. Unless f rises from below zero to above, it may still cross zero twice in the
/// interval. If one of the two values is closer to zero than to the other value, four subintervals are therefore searched.
template <class Function>
std::optional<double> find_crossing(double from, double to, double f_from, double f_to, const Function& f) {
    if (f_from <= 0 && f_to > 0) return bisect_crossing(from, to, f);
    if (std::min(std::abs(f_from), std::abs(f_to)) > std::abs(f_to - f_from)) return {};
    constexpr int parts = 4;
    for (int k = 0; k < parts; ++k) {
        const double a = from + (to - from) * k / parts, b = k + 1 < parts ? from + (to - from) * (k + 1) / parts : to;
        if (const auto found = bisect_crossing(a, b, f)) return found;
    }
    return {};
}

}  // namespace corpuscle::circuit
