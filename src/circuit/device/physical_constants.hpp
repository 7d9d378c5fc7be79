#pragma once
// Physical constants in SI units (exact since 2019), and 0 degrees Celsius in K.

namespace corpuscle::circuit {

inline constexpr double boltzmann = 1.380649e-23, electron_charge = 1.602176634e-19, zero_celsius = 273.15;
/// kT/q, V.
constexpr double thermal_voltage(double kelvin) { return boltzmann * kelvin / electron_charge; }

}  // namespace corpuscle::circuit
