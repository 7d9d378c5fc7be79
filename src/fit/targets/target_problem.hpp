#pragma once
// Fits an afferent to a table of targets. The residual of a row is its deviation, in standard deviations: the range of the target counts as
// 1.96 of them to each side.

#include "core/simulation_options.hpp"
#include "fit/fit_problem.hpp"
#include "fit/targets/target_table.hpp"

namespace corpuscle {

struct TargetProblemOptions {
    double rate = 10e3;      ///< Hz, of the stimuli
    std::uint64_t seed = 0;  ///< of random stimuli
    double hold_out = 0;     ///< fraction of the rows that are held out besides those of `set`
};

/// Tables without a row to fit are an error.
Result<std::unique_ptr<FitProblem>> make_target_problem(std::vector<TargetRow>, const TargetProblemOptions&);

}  // namespace corpuscle
