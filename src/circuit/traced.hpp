#pragma once
// What people want to see of a circuit, as .save has it.

#include <optional>

#include "circuit/netlist/netlist.hpp"

namespace corpuscle::circuit {

/// "vf,v(a,b),i(N3B)" at the commas outside of parentheses.
std::vector<std::string> trace_words(std::string_view text);

/// "vf", "v(vf)", "v(a,b)", "i(vdd)", "i(N3B)" as .save has it: "i(xsummer.mn3b)". Names as in path_names.hpp. Nothing: the circuit has no
/// such node or device. Refused: what may be more than one of them, and what has no current to be told.
Result<std::optional<std::string>> traced(const Circuit&, std::string_view word);

/// What it may have meant: "; did you mean 'v(hpb)'?"
std::string meant_trace(const Circuit&, std::string_view word);

}  // namespace corpuscle::circuit
