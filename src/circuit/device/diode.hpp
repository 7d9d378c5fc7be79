#pragma once
// The junction diode of SPICE, level 1.

#include "circuit/device/device.hpp"

namespace corpuscle::circuit {

Result<std::unique_ptr<Device>> make_diode(const Element&, DeviceSetup&);

/// Limits the Newton step of a junction voltage v (V), after Nagel's SPICE2. A large forward step is shortened to the voltage at which the
/// exponential reaches the current that the linearization predicts. The voltage of the last evaluation is v_before. The exponential has
/// n kT/q = n_vt, and its largest curvature at v_crit. Returns true if the step was shortened.
bool limit_junction(double& v, double v_before, double n_vt, double v_crit);

}  // namespace corpuscle::circuit
