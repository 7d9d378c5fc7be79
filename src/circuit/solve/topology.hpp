#pragma once
// What a circuit's wiring alone tells: that it has no answer at 0 Hz, and why.

#include <optional>

#include "circuit/netlist/netlist.hpp"

namespace corpuscle::circuit {

/// Nodes without a path for current to ground (floating, or behind current sources alone); loops of elements that fix voltages.
std::optional<Error> unanswerable(const Circuit&);

/// What looks like a slip, but can be solved: nodes at which one element's one end stands.
std::vector<Error> suspicious(const Circuit&);

}  // namespace corpuscle::circuit
