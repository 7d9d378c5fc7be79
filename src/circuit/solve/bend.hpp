#pragma once
// Which polynomial is the curve between the two newest points, and how far it is off there.

#include "circuit/solve/past.hpp"
#include "circuit/solve/step_control.hpp"

namespace corpuscle::circuit {

struct Bend {
    int points = 2;
    double off = 0;  ///< half way, of what it may be

    /// Of an afferent, whose currents are only drawn; on lanes a transistor's current is a straight line that is off by more than `reltol`.
    static constexpr double current_may = 10;  ///< times what a voltage may
};

/// times: the newest point, then `seen` that lie on one smooth curve with it. worst_of(weights, points): the largest part, of what it may
/// be, that these weights leave of an unknown's values at the newest points. Of two points in all nothing tells how far off a line is.
template <class WorstOf>
Bend least_bend(std::span<const double> times, int seen, const WorstOf& worst_of) {
    constexpr double good_enough = 0.05;
    Bend best;
    bool found = false;
    for (const int points : {4, 3, 2, StepControl::curve_points}) {
        if (points > seen) continue;
        const double off = worst_of(weights_of_bend(times.first(static_cast<std::size_t>(points) + 1)), points) / StepControl::curved;
        if (!found || off < best.off) best = {points, off}, found = true;
        if (best.off < good_enough) break;
    }
    return best;
}

}  // namespace corpuscle::circuit
