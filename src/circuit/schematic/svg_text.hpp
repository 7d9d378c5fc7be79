#pragma once
// A drawing as SVG. Used inside circuit/schematic only.

#include "circuit/schematic/drawing.hpp"

namespace corpuscle::circuit::schematic {

std::string svg_of(const Drawing&);

/// The text with the characters replaced that have a meaning in XML, and without those that XML does not allow.
std::string escaped(std::string_view);

}  // namespace corpuscle::circuit::schematic
