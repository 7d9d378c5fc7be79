#pragma once
// The plan of an afferent that is a netlist.

#include "core/afferent_factory.hpp"

namespace corpuscle::circuit {

/// Plans the afferent of an embedded netlist or of a netlist file with a force input and a spike output (doc/circuits.md). Applies the
/// overrides that are for this netlist; see netlist_overrides.hpp. If the netlist has at least one of `probes`, they replace its .save
/// quantities.
Result<PlannedAfferent> plan_netlist(std::string_view name_or_path, std::span<const ParameterOverride>,
                                     std::span<const std::string> probes);

}  // namespace corpuscle::circuit
