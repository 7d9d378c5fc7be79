#pragma once
// Checks of a circuit's connections: finds circuits that have no unique DC solution.

#include <optional>

#include "circuit/netlist/netlist.hpp"

namespace corpuscle::circuit {

/// Rejects nodes without a DC path to ground (floating, or connected by current sources only) and loops of elements that fix voltages.
Result<void> check_solvable(const Circuit&);

/// Warnings for nodes that only one terminal of one element is connected to. The circuit can be solved, but this is often a typing error.
std::vector<Error> find_dangling_nodes(const Circuit&);

}  // namespace corpuscle::circuit
