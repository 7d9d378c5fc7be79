#pragma once
// The simulator that a netlist was written for, and forms whose meaning there differs. Used inside circuit/netlist only.

#include "circuit/netlist/parsed_netlist.hpp"

namespace corpuscle::circuit {

enum class Dialect { unknown, ltspice, xyce, hspice };

/// The simulator whose mark a netlist has: `.backanno` of LTspice, `.global_param` and `.options device` of Xyce, `.options runlvl` of
/// HSPICE.
Dialect recognise_dialect(const ParsedNetlist&);

/// Warns once for each form that means something else in the simulator that the netlist is written for. All forms are read as in ngspice.
void warn_about_dialect(ParsedNetlist&);

}  // namespace corpuscle::circuit
