#pragma once
// Stacks of devices along paths of direct current, from supply to ground. Used inside circuit/schematic only.

#include "circuit/schematic/drawing.hpp"

namespace corpuscle::circuit::schematic {

/// A column of a drawing: a stack of devices with their rows, or one block, port or lying device.
struct Column {
    std::vector<std::size_t> parts;  ///< from the top
    std::vector<int> rows;           ///< of the parts, from the top; empty: the height is free
    bool has_free_height() const { return rows.empty(); }
};

struct Stacks {
    std::vector<Column> columns;
    std::vector<Orientation> orientations;  ///< of each part of the level
    int row_count = 1;
};

/// Finds the columns of a level, in the order of its parts.
Stacks find_stacks(const Level&);

/// The pin at the upper, or lower, end of an upright part.
std::size_t upper_pin(const Part&, Orientation);
std::size_t lower_pin(const Part&, Orientation);

/// Orders columns: short wires, signals from left to right.
std::vector<std::size_t> order_columns(const Drawing&, const Stacks&);

}  // namespace corpuscle::circuit::schematic
