#pragma once
// A drawing of a level: placed parts, wires and names of nets.

#include "circuit/schematic/shape/shape.hpp"

namespace corpuscle::circuit::schematic {

struct PlacedPart {
    std::size_t part = 0;  ///< index in Level::parts
    Orientation orientation;
    Point at;     ///< its centre
    Shape shape;  ///< relative to the centre
    Point pin(std::size_t k) const { return at + shape.pins[k].at; }
};

/// A horizontal or vertical segment.
struct Segment {
    Point from, to;  ///< from is left of or above `to`
    Box box() const { return {from.x, from.y, to.x, to.y}; }
};

struct DrawnNet {
    std::vector<Segment> wires;
    std::vector<Point> junctions;  ///< where three or four wires or pins meet
    std::vector<Text> names;
};

struct Drawing {
    Level level;  ///< with a part for each port
    NetStyles styles;
    std::vector<PlacedPart> parts;
    std::vector<DrawnNet> nets;  ///< as in the level
    Box extent;
};

/// The pins of a net that a wire joins.
struct WiredPin {
    std::size_t placed = 0, pin = 0;
};
std::vector<std::vector<WiredPin>> wired_pins(const Drawing&);

/// Draws the wires of all nets. Returns the nets that have no path, or only a long one.
std::vector<int> route_wires(Drawing&);
/// Writes the names of nets at their wires where there is room. Returns the nets that need a name, because a label stands for them
/// elsewhere, and have no room for it.
std::vector<int> place_net_names(Drawing&);

/// Places parts in columns of transistors, from supply to ground.
void place_in_columns(Drawing&);
/// Places parts in layers of blocks, from inputs to outputs.
void place_in_layers(Drawing&);

}  // namespace corpuscle::circuit::schematic
