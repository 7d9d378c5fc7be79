#pragma once
// .print, .plot, .probe and .meas, checked against the circuit before any analysis runs.

#include "circuit/own_currents.hpp"

namespace corpuscle::circuit {

/// Refuses a curve that none of the analyses has, and a .meas that is ill-formed. Appends a warning about lines that give nothing here.
Result<void> check_requests(const System&, const OwnCurrents&, std::vector<Error>& remarks);

}  // namespace corpuscle::circuit
