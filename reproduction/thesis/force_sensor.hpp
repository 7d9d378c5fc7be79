#pragma once
// The thesis's force sensor (4.1), as the catalogue's sensor `fsr` computes it with its defaults.

namespace corpuscle {

constexpr double gram_force = 9.80665e-3;  // N

/// Conductance, S, at a force in gf.
double sensor_conductance(double gf);
/// Slope of the conductance over the force, S/gf.
double sensor_slope(double gf);

}  // namespace corpuscle
