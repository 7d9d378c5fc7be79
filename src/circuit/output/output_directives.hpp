#pragma once
// Checks .print, .plot, .probe, .meas and .expect against the circuit before any analysis runs.

#include "circuit/output/device_currents.hpp"

namespace corpuscle::circuit {

/// Returns an error if a directive names a curve or number that no analysis has, or if a .meas is ill-formed. Appends a warning for each
/// line or word that has no effect here.
Result<void> check_output_directives(const System&, const DeviceCurrents&, std::vector<Error>& warnings);

}  // namespace corpuscle::circuit
