#pragma once
// .force: the force that a netlist is tried under where nobody hands in another.

#include <optional>

#include "circuit/netlist/netlist.hpp"
#include "circuit/trace.hpp"
#include "signal/source.hpp"

namespace corpuscle::circuit {

/// .force STIMULUS [PARAMETER=VALUE ...] [rate=10k], such as ".force press f_max=2": a stimulus by name, or a sum of them, whose parameters
/// are then written press.f_max. Nothing, if the netlist has no such line.
Result<std::optional<Trace>> force_order(const Circuit&);
/// The phases of this force, if it has such.
Result<std::vector<Phase>> force_phases(const Circuit&);

}  // namespace corpuscle::circuit
