#pragma once
// Checks .print, .plot, .probe and .meas against the circuit before any analysis runs.

#include "circuit/device_currents.hpp"

namespace corpuscle::circuit {

/// A curve that no analysis has and an ill-formed .meas are errors. Appends a warning for each line that has no effect here.
Result<void> check_output_directives(const System&, const DeviceCurrents&, std::vector<Error>& warnings);

}  // namespace corpuscle::circuit
