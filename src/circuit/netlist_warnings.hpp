#pragma once
// Warnings about likely mistakes in a netlist that can be solved.

#include <vector>

#include "circuit/netlist/netlist.hpp"

namespace corpuscle::circuit {

/// Warns about sizes in metres that look like micrometres, missing sizes, unused initial conditions, .ac without an AC source, and
/// pulses longer than their period. There is one warning of each kind, located at the first element concerned.
std::vector<Error> netlist_warnings(const Circuit&);

}  // namespace corpuscle::circuit
