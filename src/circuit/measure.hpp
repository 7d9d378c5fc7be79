#pragma once
// .meas: numbers taken from curves.

#include "circuit/run.hpp"

namespace corpuscle::circuit {

/// All .meas of a circuit, in order, on what its analyses found; appended to the outcome's numbers. One that finds nothing is NaN, with
/// a remark; one that is ill-formed is an error.
Result<void> measure(const Circuit&, RunOutcome&);

}  // namespace corpuscle::circuit
