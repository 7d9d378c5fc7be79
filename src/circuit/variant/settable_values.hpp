#pragma once
// The values of a circuit that overrides can set, as a list for a user interface.

#include "circuit/netlist/netlist.hpp"
#include "core/operating_state.hpp"

namespace corpuscle::circuit {

/// The temperature, the mismatch, the array of each transistor, and each number of each device, under the names that apply_overrides()
/// accepts. Devices with a waveform or an expression are left out.
std::vector<SettableValue> settable_values_of(const Circuit&);

}  // namespace corpuscle::circuit
