#pragma once
// Searches for the equilibria of a circuit, and for the equilibrium that it reaches at power-on.

#include "circuit/analysis/analysis_context.hpp"

namespace corpuscle::circuit {

struct Equilibrium {
    std::vector<double> x;
    bool is_stable = true;     ///< small disturbances decay (find_unstable_mode)
    bool is_default = false;   ///< the equilibrium that AnalysisContext::operating_point() returns
    bool is_power_on = false;  ///< the equilibrium that the circuit reaches at power-on
};

/// Finds equilibria by a search from these points:
///
/// - the start of .op
/// - each node clamped to either supply voltage, then released
/// - the end of the power-on transient
/// - the midpoint of any two stable equilibria, because an unstable one lies between them
///
/// Two equilibria differ if a node voltage differs by more than 1 mV. The list may be incomplete. The default equilibrium is first, then
/// the stable ones, then the unstable ones, both sorted by voltages. With variation applied, these are the equilibria of that chip.
///
/// Power-on is a transient from 0 V everywhere, without .ic, in which all V and I sources rise linearly within `rise` (s) to their values
/// in .op. If it settles, its final state is an equilibrium. Otherwise no equilibrium has is_power_on.
Result<std::vector<Equilibrium>> find_equilibria(AnalysisContext&, double rise = 1e-3);

/// Describes the equilibria as text: stability, which is the default and which the power-on state, and the nodes that differ from the
/// first.
std::string describe(const AnalysisContext&, const std::vector<Equilibrium>&);

}  // namespace corpuscle::circuit
