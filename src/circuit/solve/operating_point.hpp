#pragma once
// The DC operating point of a circuit: f(x) = 0, by Newton's method, or by continuation methods if Newton's method diverges.

#include <string>
#include <vector>

#include "circuit/solve/system.hpp"

namespace corpuscle::circuit {

/// Convergence tolerances and iteration limit. The names are those of SPICE; the defaults are tighter, for currents of picoamperes.
struct Tolerances {
    double reltol = 1e-6;
    double vntol = 1e-9;    ///< V
    double abstol = 1e-16;  ///< A
    double gmin = 1e-15;    ///< S
    int itl1 = 100;         ///< maximum number of Newton iterations in one attempt

    /// From .options. Errors: a value out of range.
    static Result<Tolerances> from_options(const Circuit&);
};

struct OperatingPoint {
    std::vector<double> x;
    std::string_view method;  ///< "newton", "gmin", "source", "pseudo-transient"
    int iterations = 0;       ///< Newton iterations of all attempts
};

/// Conductances that pull nodes to given voltages: conductance (x - voltage) is added to the equation of each node. Empty: no clamps.
struct NodeClamps {
    std::vector<double> conductance, voltage;
};

/// Newton's method for one system. It refers to the system and keeps the symbolic analysis of its matrix.
struct NewtonSolver {
    const System& system;
    Tolerances tolerances;
    EvalContext context;
    LinearSolver<double> linear_solver;
    SystemEvaluation evaluation;
    std::vector<double> limiting_state;
    int iterations = 0;
    int singular_unknown = -1;  ///< unknown at which the matrix of the last solve was singular; -1: not singular
    std::vector<double> step;

    NewtonSolver(const System&, const Tolerances&);
    bool is_balanced() const;  ///< true if the last residual is below the tolerances
    /// Iterates from x; afterwards x is the last iterate. max_iterations 0: itl1. Returns true if it converged.
    bool solve(std::vector<double>& x, const NodeClamps& = {}, int max_iterations = 0);
    /// Describes the largest residual at x as text: the unknown, the value and the device.
    std::string describe_residual(std::span<const double> x);
};

/// Starts from `start`; if that is empty, from 0 with the voltages of .nodeset. `clamps` are part of the solved circuit.
Result<OperatingPoint> find_operating_point(NewtonSolver&, std::vector<double> start = {}, NodeClamps clamps = {});

}  // namespace corpuscle::circuit
