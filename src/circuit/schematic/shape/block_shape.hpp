#pragma once
// The shape of a block. Used inside circuit/schematic only.

#include "circuit/schematic/shape/shape.hpp"

namespace corpuscle::circuit::schematic {

/// The usual sides of the ports of a block: inputs at the left, outputs at the right, supplies and bulks above, ground below.
void set_usual_sides(const Level&, Part& block);
/// A rectangle with pins at the sides that the part names, without marks.
Shape block_shape(const Level&, const Part&);

}  // namespace corpuscle::circuit::schematic
