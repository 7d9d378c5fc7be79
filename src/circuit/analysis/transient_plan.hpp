#pragma once
// What .options say of a transient.

#include "circuit/solve/transient.hpp"

namespace corpuscle::circuit {

/// accuracy=rough|normal|fine|finest, reltol, vntol, abstol, method=gear|trap, maxord; a word or number that is none of these is refused.
Result<TransientPlan> transient_plan(const Circuit&);

}  // namespace corpuscle::circuit
