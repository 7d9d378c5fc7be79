#pragma once
// A chip under the press stimulus, beside the model that it implements.

#include "reproduction/thesis/press.hpp"

namespace corpuscle {

struct ChipVsModel {
    TrialResult chip;                  ///< with the requested probes
    std::vector<double> model_spikes;  ///< spike times of the model, s
};
/// Runs the chip as requested, and the model ("sa1") with the thesis's parameters.
Result<ChipVsModel> compare_chip_with_model(const TrialSpec& chip, const std::string& model);

/// The smallest jump of a trace at a spike. The jump is a ratio: the largest value within `duration` (s) after the spike, over the largest
/// value before it (from 2 to 0.5 times `duration` before). Infinity if there are no spikes.
double min_jump_ratio(const StudyCurve& trace, const std::vector<double>& spikes, double duration);

/// The longest time (s) for which a trace stays at or above a level.
double longest_time_above(const StudyCurve& trace, double level);

}  // namespace corpuscle
