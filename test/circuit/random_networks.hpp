#pragma once
// Random circuits of sources, resistors, capacitors, coils, diodes, transistors and formulas, with a transient each.

#include "circuit/random_circuits.hpp"

namespace corpuscle::circuit {

/// A circuit with a single stable state for each input: formulas and gates depend only on nodes nearer to the source than their output.
/// The netlist has a .tran and .meas lines of every node, but neither a title nor .options.
std::string make_random_network(RandomSource&);

}  // namespace corpuscle::circuit
