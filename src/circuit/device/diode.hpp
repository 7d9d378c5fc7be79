#pragma once
// The junction diode of SPICE, level 1.

#include "circuit/device/device.hpp"

namespace corpuscle::circuit {

Result<std::unique_ptr<Device>> make_diode(const Element&, Setup&);

/// Where Newton's next look at a junction's exponential may be: a step far up is shortened to where the current grows as the step's
/// straight line says (after Nagel's SPICE2). v: wanted, V; before: the last look; n_vt: of the exponential; v_crit: where it bends.
/// Returns whether it was shortened.
bool limit_junction(double& v, double before, double n_vt, double v_crit);

}  // namespace corpuscle::circuit
