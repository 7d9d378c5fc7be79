#pragma once
// Reference transients: integrates a circuit's equations with IDA of SUNDIALS, at much tighter tolerances than Corpuscle's own transient.

#include <span>
#include <string>
#include <vector>

#include "circuit/solve/system.hpp"

namespace corpuscle::circuit {

/// Options of one integration. Optionally records the times when one unknown rises through a level.
struct IdaOptions {
    double step = 0, stop = 0;           ///< s; step and end of .tran, which the sources use for their defaults
    std::vector<double> output_times{};  ///< s, ascending; the times at which x is stored
    int crossing_unknown = -1;           ///< index of the unknown whose rises through crossing_level are recorded; -1 for none
    double crossing_level = 0;           ///< V, or A if the unknown is a current
    double reltol = 1e-9, vntol = 1e-9;  ///< relative; absolute, V. A charge has vntol times the capacitance of its node
    long max_steps = 20'000'000;
};

struct IdaResult {
    std::vector<std::vector<double>> x;  ///< all unknowns at each output time
    std::vector<double> crossings;       ///< s; times at which the chosen unknown rises through the level
    long steps = 0, evaluations = 0;
    std::string error;  ///< why the run stopped before the end; empty if it reached the end
};

/// Integrates from `start` (x at t = 0):
///     f(x, t) + dq/dt = 0,   q - q(x) = 0   in the unknowns (x, q), so that charge is conserved where node voltages jump.
/// Here f are the resistive currents into the nodes and q(x) their charges. Stops at each breakpoint of a source and restarts there. The
/// error of a current through a source is not controlled, because that current contains the derivative of a charge.
IdaResult integrate_with_ida(System&, double gmin, const std::vector<double>& start, const IdaOptions&);

}  // namespace corpuscle::circuit
