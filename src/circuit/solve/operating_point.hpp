#pragma once
// The DC operating point of a circuit: f(x) = 0, by Newton's method, or by continuation methods if Newton's method diverges.

#include <functional>

#include "circuit/solve/system.hpp"

namespace corpuscle::circuit {

/// The smallest default of gmin of all kinds of devices in the circuit, S. Nothing if it has no junctions.
std::optional<double> smallest_gmin(const Circuit&);

/// Convergence tolerances and iteration limit of Newton's method. The names are those of SPICE. Defaults are tighter than SPICE's, for
/// currents of picoamperes.
struct Tolerances {
    double reltol = 1e-6;   ///< relative to an unknown, or to the largest term of an equation
    double vntol = 1e-9;    ///< V, added for voltages
    double abstol = 1e-16;  ///< A, added for currents
    double gmin = 1e-15;    ///< S, in parallel with every junction; the default is the smallest of all kinds in the circuit
    int itl1 = 100;         ///< maximum number of Newton iterations in one attempt

    /// From .options.
    static Tolerances from_options(const Circuit&);
};

struct OperatingPoint {
    std::vector<double> x;
    std::string_view method;     ///< that found it: "newton", "gmin", "source", "pseudo-transient"
    int iterations = 0;          ///< Newton iterations of all attempts
    std::vector<char> states{};  ///< of the devices with states
};

/// Conductances (S) that pull nodes to given voltages (V), by node: the current conductance * (x - voltage) is added to the equation of
/// each node. Empty: no clamps.
struct NodeClamps {
    std::vector<double> conductance, voltage;
};

/// Newton's method for one system, which must outlive it.
struct NewtonSolver {
    const System& system;
    Tolerances tolerances;
    EvalContext context;
    LinearSolver<double> linear_solver;
    SystemEvaluation evaluation;
    std::vector<double> limiting_state;
    int iterations = 0;         ///< of all calls of solve(); set to 0 by the caller
    int singular_unknown = -1;  ///< unknown at which the matrix of the last solve() was singular; -1: not singular, or not known
    std::vector<double> step;   ///< the last Newton step
    std::function<bool()> should_stop = {};  ///< called in each iteration of solve(); if it returns true, solve() fails

    NewtonSolver(const System&, const Tolerances&);
    /// The smallest residual that counts: A for the equation of a node, which is a sum of currents; V for that of a branch current.
    double floor_of(std::size_t equation) const;
    bool is_stopped() const { return should_stop && should_stop(); }
    bool is_balanced() const;  ///< true if the residual of the last evaluation is below the tolerances
    /// Iterates from x; afterwards x is the last iterate. A max_iterations of 0 means itl1. Returns true if the iterations converged.
    bool solve(std::vector<double>& x, const NodeClamps& = {}, int max_iterations = 0);
    /// Describes the largest residual at x as text: the unknown, the value and the device. In a transient dq/dt = a q + `history`.
    std::string describe_residual(std::span<const double> x, double a = 0, std::span<const double> history = {});
};

/// Finds an operating point. The search starts from the unknowns in `start`; if it is empty, from 0 with the voltages of .nodeset. The
/// solution includes the effect of `clamps`. Devices with states begin in their present states, which change until they agree with the
/// solution; they keep those of the last solution found. An error of code `interrupted` if NewtonSolver::should_stop has ended the search.
Result<OperatingPoint> find_operating_point(NewtonSolver&, std::vector<double> start = {}, NodeClamps clamps = {});

/// The fastest growing disturbance of an unstable operating point.
struct UnstableMode {
    std::vector<double> direction;  ///< by unknown; the largest voltage is 1
    double rate;                    ///< 1/s; 0: it oscillates while it grows, and the rate is not known
};

/// Examines a circuit at x, where f(x) = 0. Returns nothing if all disturbances decay. Growth with a time constant above about 100 s, or of
/// an oscillation by less than about 1 % per cycle, is not detected.
std::optional<UnstableMode> find_unstable_mode(NewtonSolver&, std::span<const double> x);

}  // namespace corpuscle::circuit
