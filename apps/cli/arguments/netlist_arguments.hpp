#pragma once
// The netlist options of respond and run, and their conversion to overrides and probe names.

#include <optional>
#include <string>
#include <vector>

#include "cli/arguments/option_rows.hpp"
#include "core/parameter_override.hpp"

namespace corpuscle {

/// Options that apply to every netlist of the run.
struct NetlistArguments {
    std::optional<std::string> supply, temp, corner, mismatch;
    std::vector<std::string> probes;
};

OptionGroup netlist_options(NetlistArguments&);

/// The overrides from --supply, --temp, --corner and --mismatch, which are for every netlist.
std::vector<ParameterOverride> netlist_overrides(const NetlistArguments&);

/// The names of all probes in the --probe options, each of which may have several.
std::vector<std::string> probe_names(const NetlistArguments&);

}  // namespace corpuscle
