#pragma once
// Where a chip works: its responses to the thesis's press stimulus at many operating conditions, compared with its model's.

#include <array>
#include <utility>

#include "reproduction/thesis/chip_conditions.hpp"
#include "reproduction/thesis/press.hpp"

namespace corpuscle {

/// Spikes at rest, in protraction, plateau, retraction and after.
using PhaseCounts = std::array<double, 5>;

/// The response of a chip at one condition.
struct ConditionTrial {
    ConditionResponse response;
    PhaseCounts counts;
    /// It is silent at rest and fires where its model does. SA-I: while the force rises and in the last 100 ms of the plateau, not after
    /// retraction. FA-I: in both ramps, not in those 100 ms.
    bool works = false;
    /// It is silent at rest, and its number of spikes in each other phase is within the limits.
    bool within_limits = false;
};

struct ChipRange {
    std::string chip;
    PhaseCounts model;                   ///< of its model
    std::vector<ConditionTrial> trials;  ///< in the order of the conditions

    /// The trial at a condition that was tried.
    const ConditionTrial& at(const ChipCondition&) const;
    /// Limits of the number of spikes in a phase (index in PhaseCounts): the model's, less or more a quarter or one spike; at rest 0.
    std::pair<double, double> limits(std::size_t phase) const;
    /// "4 to 6 / 7 to 11 / 0 to 2 / 0 to 1": the limits after the rest.
    std::string limits_text() const;
};

/// Simulates a chip ("sa1-circuit") and its model. `progress` is called with the finished fraction; must return false to stop.
Result<ChipRange> explore_range(const std::string& chip, const std::vector<ChipCondition>&, const std::function<bool(double)>& progress);

}  // namespace corpuscle
