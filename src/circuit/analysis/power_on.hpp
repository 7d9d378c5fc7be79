#pragma once
// The state that a circuit reaches at power-on.

#include "circuit/analysis/analysis_context.hpp"

namespace corpuscle::circuit {

/// The unknowns at the end of a transient that starts at 0 V everywhere, without .ic, while all V and I sources rise from 0 within `rise`
/// (s). Returns nothing if the circuit keeps oscillating.
Result<std::optional<std::vector<double>>> power_on_state(const AnalysisContext&, double rise);

}  // namespace corpuscle::circuit
