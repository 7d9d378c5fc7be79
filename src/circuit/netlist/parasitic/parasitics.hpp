#pragma once
// Parasitic elements that the line of a C, L or V gives by name, as in LTspice.

#include "circuit/netlist/netlist.hpp"

namespace corpuscle::circuit {

class CircuitBuilder;

/// Adds an R, C or L for each of rser=, lser=, rpar= and cpar= of a capacitor, of rpar= and cpar= of an inductor, and of rser= and cpar= of
/// a voltage source. A value of 0 adds none. Those in series are between the element, which gets an inner node, and its second node; those
/// in parallel are between the two nodes of the line. They are m-fold like the element; `m` is that of the subcircuits around a source. The
/// series resistance of an inductor is a part of its own device.
Result<void> add_parasitics(CircuitBuilder&, Element&, double m);

}  // namespace corpuscle::circuit
