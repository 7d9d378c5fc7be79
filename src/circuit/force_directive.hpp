#pragma once
// .force: the default force of a netlist, used if the caller provides none.

#include <optional>

#include "circuit/force_waveform.hpp"
#include "circuit/netlist/netlist.hpp"
#include "signal/force_source.hpp"

namespace corpuscle::circuit {

/// Reads .force STIMULUS [PARAMETER=VALUE ...] [rate=10k], such as ".force press f_max=2". STIMULUS is the name of a stimulus or a sum
/// of several; the parameters of a sum are written press.f_max. Returns nothing if the netlist has no .force.
Result<std::optional<ForceWaveform>> force_directive(const Circuit&);
/// The phases of the stimulus in .force; empty if there are none.
Result<std::vector<Phase>> force_phases(const Circuit&);

}  // namespace corpuscle::circuit
