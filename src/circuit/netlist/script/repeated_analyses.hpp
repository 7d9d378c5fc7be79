#pragma once
// Analyses that a netlist has as a directive and in a script. Used inside circuit/netlist only.

#include <span>

#include "circuit/netlist/parsed_netlist.hpp"

namespace corpuscle::circuit {

/// Removes each analysis of a script that the netlist also has as a directive. The prints and measures of the script then belong to the
/// directive. `script_analyses`: the analyses of all scripts.
void remove_repeated_analyses(ParsedNetlist&, std::span<const Statement* const> script_analyses);

}  // namespace corpuscle::circuit
