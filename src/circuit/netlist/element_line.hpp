#pragma once
// Element lines before any parameter has a value. Used inside circuit/netlist only.

#include "circuit/netlist/parsed_netlist.hpp"

namespace corpuscle::circuit {

/// Splits an element line. A letter without a device is added to the refusals; the result is then empty.
Result<std::optional<Statement>> split_element_line(LogicalLine, Refusals&);

/// True if a title looks like an element line, such as "R1 a b 1k", or like a directive.
bool looks_like_statement(std::string_view title);

/// True for a line, in small letters, that only a netlist for Spectre has: "parameters vdd=1.8".
bool is_spectre(std::string_view line);
/// True for two or more numbers between commas, semicolons, tabs or blanks, as recordings have them.
bool is_row_of_numbers(std::string_view line);

}  // namespace corpuscle::circuit
