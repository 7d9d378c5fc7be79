#pragma once
// Resolves the probes that a user names in a circuit to the names that .save uses.

#include <optional>

#include "circuit/netlist/netlist.hpp"

namespace corpuscle::circuit {

/// Splits "vf,v(a,b),i(N3B)" at the commas outside parentheses: "vf", "v(a,b)", "i(N3B)".
std::vector<std::string> split_probes(std::string_view text);

/// Turns one probe of a user into its name in .save: "i(N3B)" into "i(xsummer.mn3b)". A probe is a node, v(NODE), v(NODE,NODE), i(SOURCE)
/// or i(DEVICE). Names match as in hierarchical_names.hpp. Returns nothing if the circuit has no such node or device. An ambiguous name and
/// a device whose current cannot be recorded are errors.
Result<std::optional<std::string>> resolve_probe(const Circuit&, std::string_view probe_text);

/// A suggestion for a probe that resolve_probe() does not find: "; did you mean 'hpb'?". If no name is similar, the first names:
/// "; there are the nodes in, out".
std::string suggest_probe(const Circuit&, std::string_view probe_text);

}  // namespace corpuscle::circuit
