#pragma once
// The parameters of a transient, from .tran and .options, and its initial condition.

#include "circuit/analysis/analysis_context.hpp"
#include "circuit/solve/transient.hpp"

namespace corpuscle::circuit {

/// The plan from .options: accuracy=rough|normal|fine|finest, reltol, vntol, abstol, method=gear|trap, maxord. stop and max_step are not
/// set. Errors: an invalid value.
Result<TransientPlan> read_transient_plan(const Circuit&);

/// The words of .tran STEP STOP [START [LONGEST]] [uic].
struct TransientTimes {
    double step = 0, stop = 0, start = 0;  ///< s
    std::optional<double> max_step;        ///< s: LONGEST, if given
    bool uic = false;                      ///< true if given
};
Result<TransientTimes> read_transient_times(const Directive&);

struct InitialCondition {
    std::vector<double> x;
    bool is_consistent = true;       ///< true: x solves the equations; false (uic): only the charges at x are valid
    std::vector<double> charge{};    ///< C, by equation: charge that ic= of elements adds to the charges at x; empty: none
    std::optional<Error> warning{};  ///< says that the operating point is unstable, so that the transient starts beside it
};

/// Without uic: the operating point with the nodes of .ic clamped, searched from the unknowns `guess` if these are given. With uic: the
/// voltages of .ic, all other nodes at 0 V, capacitors with ic= charged to that voltage, inductors with ic= carrying that current. Without
/// .ic and uic, a circuit whose operating point is unstable starts 10 mV from it, in the direction of the fastest growing disturbance.
Result<InitialCondition> find_initial_condition(AnalysisContext&, bool uic, std::vector<double> guess = {});

}  // namespace corpuscle::circuit
