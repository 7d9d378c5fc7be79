#pragma once
// The part that draws an element. Used inside circuit/schematic only.

#include "circuit/schematic/level/level_nets.hpp"

namespace corpuscle::circuit::schematic {

/// The part of an element. `net` gives the net of the level for a node of the circuit.
Part part_of_element(const Circuit&, const Element&, std::string name, const std::function<int(int)>& net);

}  // namespace corpuscle::circuit::schematic
