#pragma once
// Resolves the probes that a user names in a circuit to the names that .save uses.

#include <optional>

#include "circuit/netlist/netlist.hpp"

namespace corpuscle::circuit {

/// Splits "vf,v(a,b),i(N3B)" at the commas outside parentheses.
std::vector<std::string> split_probes(std::string_view text);

/// The name in .save of "vf", "v(vf)", "v(a,b)", "i(vdd)" or "i(N3B)", such as "i(xsummer.mn3b)". Names match as in hierarchical_names.hpp.
/// Returns nothing if the circuit has no such node or device. An ambiguous name and a device whose current cannot be recorded are
/// errors.
Result<std::optional<std::string>> resolve_probe(const Circuit&, std::string_view word);

/// A suggestion for an unknown name: "; did you mean 'v(hpb)'?"
std::string suggest_probe(const Circuit&, std::string_view word);

}  // namespace corpuscle::circuit
