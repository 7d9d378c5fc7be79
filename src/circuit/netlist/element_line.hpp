#pragma once
// Element lines before any parameter has a value. Used inside circuit/netlist only.

#include "circuit/netlist/parsed_netlist.hpp"

namespace corpuscle::circuit {

/// Splits an element line. A letter without a device is added to the refusals; the result is then empty.
Result<std::optional<Statement>> split_element_line(LogicalLine, Refusals&);

/// True if a title looks like an element line, such as "R1 a b 1k", or like a directive.
bool looks_like_statement(std::string_view title);

}  // namespace corpuscle::circuit
