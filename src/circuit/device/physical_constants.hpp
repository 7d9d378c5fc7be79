#pragma once
// Physical constants in SI units (exact since 2019), and temperatures.

namespace corpuscle::circuit {

inline constexpr double boltzmann = 1.380649e-23, electron_charge = 1.602176634e-19, zero_celsius = 273.15;
inline constexpr double max_celsius = 1000;  ///< highest temperature of an element or a circuit
constexpr bool is_possible_temperature(double celsius) { return celsius > -zero_celsius && celsius <= max_celsius; }
/// kT/q, V.
constexpr double thermal_voltage(double kelvin) { return boltzmann * kelvin / electron_charge; }

}  // namespace corpuscle::circuit
