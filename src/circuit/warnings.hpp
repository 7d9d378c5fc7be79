#pragma once
// What a netlist may say by mistake although it can be solved.

#include <vector>

#include "circuit/netlist/netlist.hpp"

namespace corpuscle::circuit {

/// Sizes in metres that look like micrometres, sizes that are not given, initial conditions that are not used, .ac without a source that
/// drives it, pulses longer than their period. One warning for each kind, at the first place.
std::vector<Error> warnings_of(const Circuit&);

}  // namespace corpuscle::circuit
