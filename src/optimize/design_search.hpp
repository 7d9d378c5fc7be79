#pragma once
// The search for the best design: quasi-random designs, then rounds of local searches (Sbplx, Rowan 1990, of NLopt). Local searches
// simulate only the cases that are near their limits. After each round, their designs are simulated in all cases, and the cases that fail
// join those of the next round. The result depends on the problem alone, not on threads or on interruptions.

#include "optimize/variable_limits.hpp"
#include "sweep/store/sweep_results.hpp"

namespace corpuscle::optimize {

struct OptimizationResult {
    ScoredDesign start, found;
    std::vector<VariableLimit> limits;    ///< of each variable, at the found design
    std::size_t rounds = 0, designs = 0;  ///< number of rounds, and of designs in local searches and before
    std::size_t active_cases = 0;         ///< cases of the last round
    std::size_t simulated = 0, reused = 0;
    bool is_settled = false;  ///< true if the last round found no further case that fails
};

struct SearchCallbacks {
    unsigned threads = 0;  ///< 0: one for each core
    std::function<bool()> should_stop = [] { return false; };
    std::function<void(double fraction)> on_progress = [](double) {};
};

/// Searches for the best design. `results`: null: outcomes are not stored.
Result<OptimizationResult> optimize_design(OptimizationProblem&, SweepResults* results, const SearchCallbacks&);

}  // namespace corpuscle::optimize
