#pragma once
// The sides of gates and of the ports of blocks. Used inside circuit/schematic only.

#include "circuit/schematic/drawing.hpp"

namespace corpuscle::circuit::schematic {

/// The parts of each net of a level that wires join.
std::vector<std::vector<std::size_t>> parts_of_nets(const Drawing&);

/// Turns gates, lying devices and ports of blocks to the side where the parts are that they are joined with. `position` has the column of
/// each part, from the left.
void orient_parts(Drawing&, const std::vector<int>& position, std::vector<Orientation>&);

/// Makes the shapes of all parts, at the origin.
void make_shapes(Drawing&, const std::vector<Orientation>&);

}  // namespace corpuscle::circuit::schematic
