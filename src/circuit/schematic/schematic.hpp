#pragma once
// Schematics of a netlist as SVG, one for each level: the top level, and each block (an instance of a subcircuit).
//
// A level with transistors is drawn in columns, each of which is a path of direct current from the supply to ground. Other levels are drawn
// as blocks from left to right, along the signal. Supplies, grounds and bias voltages are labels. The same circuit gives the same bytes.
//
// The SVG has a viewBox and no size. Groups have the classes device, block, port and net, and the attributes data-device ("xsummer.mn3b"),
// data-block ("xsummer") and data-net, which are names of the flat circuit. Colours are currentColor and the variables
// --schematic-wire, --schematic-label and --schematic-quiet.

#include "circuit/netlist/netlist.hpp"

namespace corpuscle::circuit {

inline constexpr std::size_t max_schematic_parts = 500;  ///< devices, blocks and ports of a level

struct Schematic {
    std::string block;       ///< path of the instance: "xsummer", "xhpb.xres"; "" for the top level
    std::string subcircuit;  ///< "summer"; "" for the top level
    std::string svg;
};

/// Draws one level. `block`: "" for the top level, or the name of a block as in parameters: "summer" is xsummer. The name of a subcircuit
/// means its only block; of one that no X line uses, its definition is drawn. A level with more than max_schematic_parts is refused, and a
/// top level without elements, too.
Result<Schematic> draw_schematic(const Netlist&, std::string_view block);

/// Draws the top level and all blocks; an outer block comes before its parts. Levels that are too large are left out, except that a top
/// level that is too large is an error.
Result<std::vector<Schematic>> draw_schematics(const Netlist&);

}  // namespace corpuscle::circuit
