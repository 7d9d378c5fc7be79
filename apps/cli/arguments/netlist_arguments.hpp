#pragma once
// Converts the netlist options of respond and run to overrides and probe names.

#include "circuit/variant/netlist_overrides.hpp"
#include "cli/verbs.hpp"

namespace corpuscle {

/// The overrides from --supply, --temp, --corner and --mismatch.
std::vector<circuit::NetlistOverride> netlist_overrides(const NetlistArguments&);

/// The names of all probes in the --probe options, each of which may have several.
std::vector<std::string> probe_names(const NetlistArguments&);

/// The first netlist option that was given, with its value, such as "--temp 85"; "" if none was.
std::string first_netlist_option(const NetlistArguments&);

}  // namespace corpuscle
