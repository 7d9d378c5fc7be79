#pragma once
// .param, .func, .model and the head of .subckt. Used inside circuit/netlist only.

#include "circuit/netlist/parsed_netlist.hpp"

namespace corpuscle::circuit {

/// Adds the parameters and functions of a .param line to a definition.
Result<void> read_parameters(const Statement&, SubcktDef&, std::vector<Error>& warnings);

/// Adds the function of a line .func f(x, y) {text}. An '=' before the text is optional, and the text may be in quotes instead of braces.
Result<void> read_function(const LogicalLine&, SubcktDef&, std::vector<Error>& warnings);

/// Adds a .model line. A model that is already defined in the same branch of .if is an error, unless both lines have the same words.
Result<void> read_model(Statement, SubcktDef&, ParsedNetlist&);

/// Reads the ports and parameters of the .subckt line, `head`.
Result<void> read_subcircuit_head(SubcktDef&);

}  // namespace corpuscle::circuit
