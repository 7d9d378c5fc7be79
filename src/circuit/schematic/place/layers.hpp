#pragma once
// Layers of parts, from inputs to outputs. Used inside circuit/schematic only.

#include "circuit/schematic/drawing.hpp"

namespace corpuscle::circuit::schematic {

/// The layer of each part, from 0 at the left; -1 for parts that are not in `members`. Signals run from left to right, except for feedback.
std::vector<int> find_layers(const Drawing&, const std::vector<std::size_t>& members);

/// Sets the y of the parts of each layer: few crossings, straight wires. Their shapes must be made.
void set_heights(Drawing&, const std::vector<std::vector<std::size_t>>& layers);

}  // namespace corpuscle::circuit::schematic
