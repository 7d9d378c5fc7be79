#pragma once
// .force: the default force of a netlist, used if the caller provides no force.

#include <optional>

#include "circuit/afferent/force_waveform.hpp"
#include "circuit/netlist/netlist.hpp"
#include "core/force_source.hpp"

namespace corpuscle::circuit {

/// Reads .force STIMULUS [PARAMETER=VALUE ...] [rate=10k], such as ".force press f_max=2". STIMULUS is the name of a stimulus or a sum
/// such as press+noise. In a sum, a parameter is written with its stimulus: press.f_max. The sample rate is in Hz. Returns nothing if
/// the netlist has no .force.
Result<std::optional<ForceWaveform>> force_directive(const Circuit&);
/// The phases of the stimulus in .force; empty if the netlist has no .force or the stimulus has no phases.
Result<std::vector<Phase>> force_phases(const Circuit&);

/// "pwl(0 0.2 0.25 0.2 ...)" in several lines: the force of .force times `scale` (V/N or A/N). It differs from the samples of the force by
/// at most 1e-4 of the largest force. "" if the netlist has no .force.
Result<std::string> pwl_force(const Circuit&, double scale);

}  // namespace corpuscle::circuit
