#pragma once
// Chooses the polynomial that interpolates between the two newest points, and estimates its error between them.

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

}  // namespace corpuscle::circuit
