#pragma once
// Chooses the polynomial that interpolates between the two newest points, and estimates its error between them. Finds the time at which a
// function of time crosses zero upwards.

#include <algorithm>
#include <cmath>
#include <optional>

#include "circuit/solve/history.hpp"
#include "circuit/solve/step_control.hpp"

namespace corpuscle::circuit {

/// A polynomial through the newest points, and its error.
struct Interpolant {
    int points = 2;    ///< number of points that the polynomial passes through
    double error = 0;  ///< error at mid-step, relative to the allowed error of an interpolation

    /// Factor of the tolerance of currents in the simulation of an afferent, where currents are only plotted. On lanes the linearized
    /// current of a transistor has an error above `reltol`.
    static constexpr double current_tolerance_factor = 10;
};

/// Chooses the polynomial. `times` are those of the newest point, then of the `smooth_count` points that lie on one smooth curve with it.
/// The function worst_of(weights, points) must return the largest weighted sum of an unknown's values at the newest `points` + 1 points,
/// relative to its allowed error. With only two points there is no estimate; the error is 0.
template <class WorstOf>
Interpolant best_interpolant(std::span<const double> times, int smooth_count, const WorstOf& worst_of) {
    constexpr double good_enough = 0.05;  // relative error at which no other number of points is tried
    Interpolant best;
    bool found = false;
    for (const int points : {4, 3, 2, StepControl::max_curve_points}) {
        if (points > smooth_count) continue;
        const double error = worst_of(weights_of_interpolation_error(times.first(static_cast<std::size_t>(points) + 1)), points) /
                             StepControl::curve_tolerance;
        if (!found || error < best.error) best = {points, error}, found = true;
        if (best.error < good_enough) break;
    }
    return best;
}

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
