#pragma once
// Reads the parameters of a transient from .tran and .options.

#include "circuit/analysis/analysis_context.hpp"
#include "circuit/solve/transient.hpp"

namespace corpuscle::circuit {

/// From .options: accuracy=rough|normal|fine|finest, reltol, vntol, abstol, method=gear|trap, maxord. Errors: an invalid value.
Result<TransientPlan> read_transient_plan(const Circuit&);

/// .tran STEP STOP [START [LONGEST]] [uic]
struct TransientTimes {
    double step = 0, stop = 0, start = 0;  ///< s
    std::optional<double> max_step;        ///< s, if given
    bool uic = false;
};
Result<TransientTimes> read_transient_times(const Directive&);

}  // namespace corpuscle::circuit
