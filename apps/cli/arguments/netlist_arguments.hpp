#pragma once
// The netlist options of respond and run.

#include <string>
#include <vector>

#include "cli/arguments/option_rows.hpp"
#include "core/parameter_override.hpp"

namespace corpuscle {

/// Options that apply to every netlist of the run.
struct NetlistArguments {
    std::vector<ParameterOverride> overrides;  ///< --supply, --temp, --corner and --mismatch
    std::vector<std::string> probes;           ///< of all --probe options, each of which may have several
};

OptionGroup netlist_options(NetlistArguments&);

}  // namespace corpuscle
