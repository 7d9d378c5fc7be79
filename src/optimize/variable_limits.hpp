#pragma once
// The limits of the goal at a found design: the effect of one step of each variable.

#include "optimize/design_score.hpp"

namespace corpuscle::optimize {

/// A design and its score in all cases.
struct ScoredDesign {
    std::vector<double> values;  ///< of the variables
    DesignScore score;
    std::vector<CaseScore> cases;  ///< of each case of the problem
    double merit = 0;
};

/// The effect of moving one variable away from the found design, with all other variables as they are.
struct VariableStep {
    double value = 0;  ///< of the variable
    double goal = 0;   ///< NaN: no value
    bool is_within = false;
    double excess = 0;           ///< as in DesignScore
    std::size_t worst_case = 0;  ///< as in DesignScore
    std::string limit = {};
};

/// Why a variable is not further in the direction that improves the goal.
struct VariableLimit {
    double sensitivity = 0;  ///< relative change of the goal over relative change of the variable; NaN: not known
    bool is_at_min = false, is_at_max = false;
    std::optional<VariableStep> down, up;  ///< no value: the bound is reached
};

/// A design in which one variable is one step away from those of another design.
struct DesignStep {
    std::size_t variable;
    int direction;  ///< -1 or 1
    std::vector<double> design;
};
/// Steps of 2 % of a variable's range, or of one for an integer, in both directions unless a bound is in the way.
std::vector<DesignStep> steps_from(const OptimizationProblem&, const std::vector<double>& design);
/// The limits of all variables. `scored`: the designs of the steps.
std::vector<VariableLimit> variable_limits(const OptimizationProblem&, const ScoredDesign& found, std::span<const DesignStep>,
                                           std::span<const ScoredDesign> scored);

}  // namespace corpuscle::optimize
