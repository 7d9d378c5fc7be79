#pragma once
// Draws a level: decides which nets are wires, places the parts, and routes the wires.

#include "circuit/schematic/drawing.hpp"

namespace corpuscle::circuit::schematic {

Drawing draw_level(Level);

}  // namespace corpuscle::circuit::schematic
