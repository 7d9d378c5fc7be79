#pragma once
// How good a design is: its goal, and how far its simulations are within the limits or outside them.

#include "optimize/problem.hpp"

namespace corpuscle::optimize {

/// One simulation against the limits.
struct CaseScore {
    bool is_within = false;  ///< meets all limits
    /// The largest excess over a limit, in units of half its allowed range; negative: the distance from the nearest limit, by which all
    /// limits are met. An excess counts min_excess more.
    double excess = 0;
    std::string limit = {};  ///< the limit of `excess`: "spikes in plateau", "power above 2 uW", "did not converge"
    double value = 0;        ///< that of the goal in this case; NaN: it has none
};

/// A design in all cases that were simulated.
struct DesignScore {
    bool is_within = false;                   ///< all conditions, and the required fraction of the chips, meet the limits
    double goal = 0;                          ///< NaN: it has no value
    double excess = 0;                        ///< the worst of all conditions, and that of the chips, see CaseScore
    std::size_t worst_case = 0;               ///< index of the case to which `excess` belongs
    std::string limit = {};                   ///< the limit that this case is nearest to
    std::size_t chips = 0, chips_within = 0;  ///< of those simulated
};

inline constexpr double min_excess = 0.01;

/// `number`: index of the case.
CaseScore score_case(const OptimizationProblem&, std::size_t number, const ItemOutcome&);
/// The score from the scores of these cases (indices in OptimizationProblem::cases, in ascending order).
DesignScore score_design(const OptimizationProblem&, std::span<const std::size_t> cases, std::span<const CaseScore>);

/// The number that the search minimizes: the goal relative to `reference` (the magnitude of the goal of the present design), and a penalty
/// for a design that is not within the limits. A design within the limits is better than one with the same goal outside them.
double merit(const OptimizationProblem&, const DesignScore&, double reference);

}  // namespace corpuscle::optimize
