#pragma once
// What .tran and .options say of a transient.

#include "circuit/analysis/bench.hpp"
#include "circuit/solve/transient.hpp"

namespace corpuscle::circuit {

/// accuracy=rough|normal|fine|finest, reltol, vntol, abstol, method=gear|trap, maxord; a word or number that is none of these is refused.
Result<TransientPlan> transient_plan(const Circuit&);

/// .tran STEP STOP [START [LONGEST]] [uic]
struct TransientTimes {
    double step = 0, stop = 0, start = 0;  ///< s
    std::optional<double> longest;         ///< s, if it is said
    bool uic = false;
};
Result<TransientTimes> transient_times(const Command&);

}  // namespace corpuscle::circuit
