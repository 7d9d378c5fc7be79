#pragma once
// The initial condition of a transient.

#include "circuit/analysis/analysis_context.hpp"

namespace corpuscle::circuit {

struct InitialCondition {
    std::vector<double> x;
    bool is_consistent = true;       ///< false (uic): only the charges are consistent; the other unknowns follow from them
    std::vector<double> charge{};    ///< by equation: charge that ic= of elements adds to the charges at x; may be empty
    std::optional<Error> warning{};  ///< the operating point is unstable, so the transient starts beside it
};

/// The operating point with the nodes of .ic clamped; the search starts from `guess`. With uic: the voltages of .ic, all other nodes at 0
/// V, capacitors with ic= charged to that voltage, inductors with ic= carrying that current. A circuit without .ic whose operating point is
/// unstable starts 10 mV from it, in the direction of the fastest growing disturbance.
Result<InitialCondition> find_initial_condition(AnalysisContext&, bool uic, std::vector<double> guess = {});

}  // namespace corpuscle::circuit
