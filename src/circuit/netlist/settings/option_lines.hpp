#pragma once
// .options and .temp.

#include "circuit/netlist/scope.hpp"

namespace corpuscle::circuit {

/// Reads the lines of .options, then the overrides of options, then .temp, then the overrides of temperature and mismatch. Several
/// temperatures in a .temp line add a .step. `top`: the scope of the top level.
Result<void> read_settings(const ParsedNetlist&, const Scope& top, const ResolvedOverrides&, Circuit&);

}  // namespace corpuscle::circuit
