#pragma once
// Breaks long rows of parts. Used inside circuit/schematic only.

#include "circuit/schematic/drawing.hpp"

namespace corpuscle::circuit::schematic {

/// Breaks placed parts that form a very long row into several rows below each other, or a very tall column into several columns beside each
/// other. It cuts between parts where few nets cross; the router draws these nets as wires or as labels. Returns the extent of the parts.
Box fold(Drawing&, const std::vector<std::size_t>& parts);

}  // namespace corpuscle::circuit::schematic
