#pragma once
// Warnings about likely mistakes in a valid netlist.

#include <vector>

#include "circuit/netlist/netlist.hpp"

namespace corpuscle::circuit {

/// Warns about transistor sizes in metres that were probably meant in micrometres, missing sizes, ic= and off without effect, .ac without
/// an AC source, pulses longer than their period, and a .tran whose STEP is longer than STOP. There is one warning of each kind for all
/// elements, located at the first of them, and one for each such .tran.
std::vector<Error> netlist_warnings(const Circuit&);

}  // namespace corpuscle::circuit
