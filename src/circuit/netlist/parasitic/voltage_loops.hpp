#pragma once
// Loops of elements that fix voltages at 0 Hz.

#include "circuit/netlist/netlist.hpp"

namespace corpuscle::circuit {

/// True if the element fixes the voltage between its first two nodes at 0 Hz: a source of a voltage, or an inductor without resistance.
bool fixes_voltage(const Element&);

/// Gives 1 milliohm in series (as LTspice) to every inductor without resistance that closes a loop of such elements, with a warning. At
/// 0 Hz the equations would not determine the current in the loop.
void add_resistance_in_loops(Circuit&);

}  // namespace corpuscle::circuit
