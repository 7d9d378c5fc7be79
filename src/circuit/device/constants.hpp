#pragma once
// Constants of nature, SI (exact since 2019), and where Celsius begins.

namespace corpuscle::circuit {

inline constexpr double boltzmann = 1.380649e-23, electron_charge = 1.602176634e-19, zero_celsius = 273.15;
/// kT/q, V.
constexpr double thermal_voltage(double kelvin) { return boltzmann * kelvin / electron_charge; }

}  // namespace corpuscle::circuit
