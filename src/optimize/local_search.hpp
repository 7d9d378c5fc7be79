#pragma once
// One local search, by NLopt.

#include "optimize/design_evaluator.hpp"

namespace corpuscle::optimize {

/// Finds a design with a smaller merit near another one. Its designs have numbers from 0 on; see DesignEvaluator.
class LocalSearch {
    const OptimizationProblem& problem_;
    DesignEvaluator& evaluator_;
    std::int64_t search_;             // number of this search
    std::vector<std::size_t> cases_;  // that are simulated
    double reference_;                // see merit()
    std::int64_t evaluations_ = 0;
    std::map<std::vector<double>, double> known_;  // merit by design: integers are rounded, so designs repeat
    std::vector<double> best_;
    double best_merit_;

public:
    LocalSearch(const OptimizationProblem& problem, DesignEvaluator& evaluator, std::int64_t search, std::vector<std::size_t> cases,
                double reference);
    /// Searches from a design, with this first step (fraction of the range of a variable) and at most this many designs. If the search must
    /// end early, the result has no meaning.
    void run(const std::vector<double>& start, double step, std::size_t evaluations);
    const std::vector<double>& best() const { return best_; }
    std::size_t evaluations() const { return static_cast<std::size_t>(evaluations_); }

private:
    struct Objective;
    /// The merit of a design; no value: the search must end.
    std::optional<double> merit_of(const std::vector<double>& design);
};

}  // namespace corpuscle::optimize
