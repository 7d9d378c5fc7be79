#pragma once
// A netlist's own force as points of straight lines, for simulators that know of no force.

#include "circuit/netlist/netlist.hpp"

namespace corpuscle::circuit {

/// "pwl(0 0.2 0.25 0.2 ...)", the force of .force times `scale`, within 1e-4 of its largest; several lines. "": the netlist has no .force.
Result<std::string> force_points(const Circuit&, double scale);

}  // namespace corpuscle::circuit
