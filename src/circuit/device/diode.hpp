#pragma once
// The junction diode of SPICE, level 1.

#include "circuit/device/device.hpp"

namespace corpuscle::circuit {

Result<std::unique_ptr<Device>> make_diode(const Element&, DeviceSetup&);

/// Limits a Newton step that ends at the junction voltage v (V), after Nagel's SPICE2. A large forward step is shortened to the voltage at
/// which the exponential reaches the current that the linearization predicts. v_before: voltage of the last evaluation; n_vt: n kT/q;
/// v_crit: voltage at which the curve of the current over the voltage bends most (all in V). Returns true if the step was shortened.
bool limit_junction(double& v, double v_before, double n_vt, double v_crit);

}  // namespace corpuscle::circuit
