#pragma once
// The .force of a netlist as a piecewise linear source, for simulators without a force input.

#include "circuit/netlist/netlist.hpp"

namespace corpuscle::circuit {

/// "pwl(0 0.2 0.25 0.2 ...)" in several lines: the force of .force times `scale` (V/N or A/N). It differs from the samples of the force by
/// at most 1e-4 of the largest force. "" if the netlist has no .force.
Result<std::string> pwl_force(const Circuit&, double scale);

}  // namespace corpuscle::circuit
