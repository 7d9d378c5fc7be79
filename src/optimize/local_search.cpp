#include "optimize/local_search.hpp"

#include <nlopt.h>
#include <algorithm>
#include <limits>

namespace corpuscle::optimize {

LocalSearch::LocalSearch(const OptimizationProblem& problem, DesignEvaluator& evaluator, std::int64_t search,
                         std::vector<std::size_t> cases, double reference)
    : problem_(problem), evaluator_(evaluator), search_(search), cases_(std::move(cases)), reference_(reference),
      best_merit_(std::numeric_limits<double>::infinity()) {}

std::optional<double> LocalSearch::merit_of(const std::vector<double>& design) {
    if (const auto known = known_.find(design); known != known_.end()) return known->second;
    const auto scores = evaluator_.evaluate(search_, evaluations_++, design, cases_);
    if (scores.empty()) return {};
    const double value = merit(problem_, score_design(problem_, cases_, scores), reference_);
    if (value < best_merit_) best_merit_ = value, best_ = design;
    known_.emplace(design, value);
    return value;
}

/// Passes NLopt's calls to a search. No exception may pass through NLopt, which is in C.
struct LocalSearch::Objective {
    LocalSearch& search;
    nlopt_opt optimizer;
    std::size_t max_evaluations;
    std::exception_ptr exception = nullptr;

    static double evaluate(unsigned n, const double* x, double*, void* self) {
        auto& objective = *static_cast<Objective*>(self);
        try {
            std::vector<double> design(n);
            for (unsigned k = 0; k < n; ++k) design[k] = objective.search.problem_.variables[k].value(x[k]);
            if (const auto value = objective.search.merit_of(design)) {
                if (objective.search.evaluations() >= objective.max_evaluations) nlopt_force_stop(objective.optimizer);
                return *value;
            }
        } catch (...) {
            objective.exception = std::current_exception();
        }
        nlopt_force_stop(objective.optimizer);
        return std::numeric_limits<double>::max();
    }
};

void LocalSearch::run(const std::vector<double>& start, double step, std::size_t evaluations) {
    const auto n = static_cast<unsigned>(start.size());
    const std::unique_ptr<nlopt_opt_s, void (*)(nlopt_opt)> owner(nlopt_create(NLOPT_LN_SBPLX, n), nlopt_destroy);
    Objective objective{*this, owner.get(), evaluations};
    nlopt_set_lower_bounds1(owner.get(), 0);
    nlopt_set_upper_bounds1(owner.get(), 1);
    nlopt_set_min_objective(owner.get(), Objective::evaluate, &objective);
    nlopt_set_maxeval(owner.get(), static_cast<int>(20 * evaluations));  // repeated designs are not simulated again
    nlopt_set_xtol_abs1(owner.get(), step / 100);
    nlopt_set_ftol_rel(owner.get(), 1e-5);
    std::vector<double> x, steps;
    for (unsigned k = 0; k < n; ++k) {
        const auto& v = problem_.variables[k];
        x.push_back(v.position(start[k]));
        const double length = v.is_integer && v.max > v.min ? std::max(step, 1.01 / (v.max - v.min)) : step;
        steps.push_back(x[k] > 0.5 ? -length : length);  // towards the middle, so that no step leaves the range
    }
    nlopt_set_initial_step(owner.get(), steps.data());
    best_ = start;
    double found = 0;
    nlopt_optimize(owner.get(), x.data(), &found);
    if (objective.exception) std::rethrow_exception(objective.exception);
}

}  // namespace corpuscle::optimize
