#pragma once
// Reads the parameters of a transient from .tran and .options.

#include "circuit/analysis/analysis_context.hpp"
#include "circuit/solve/transient.hpp"

namespace corpuscle::circuit {

/// The plan from .options: accuracy=rough|normal|fine|finest, reltol, vntol, abstol, method=gear|trap, maxord. stop and max_step are not
/// set. Errors: an invalid value.
Result<TransientPlan> read_transient_plan(const Circuit&);

/// The words of .tran STEP STOP [START [LONGEST]] [uic].
struct TransientTimes {
    double step = 0, stop = 0, start = 0;  ///< s
    std::optional<double> max_step;        ///< s: LONGEST, if given
    bool uic = false;                      ///< true if given
};
Result<TransientTimes> read_transient_times(const Directive&);

}  // namespace corpuscle::circuit
