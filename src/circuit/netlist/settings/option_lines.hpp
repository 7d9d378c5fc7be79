#pragma once
// .options and .temp.

#include "circuit/netlist/scope.hpp"

namespace corpuscle::circuit {

/// Reads the lines of .options and .temp into the circuit, then applies the overrides of options, temperature and mismatch. `top`: the
/// scope of the top level.
Result<void> read_settings(const ParsedNetlist&, const Scope& top, const ResolvedOverrides&, Circuit&);

}  // namespace corpuscle::circuit
