#pragma once
// A chip under the press stimulus, beside the model that it implements.

#include "study/thesis/press.hpp"

namespace corpuscle {

struct ChipVsModel {
    TrialResult chip;                  ///< with the requested probes
    std::vector<double> model_spikes;  ///< spike times of the model, s
};
/// Runs the chip as requested, and the model with the thesis's parameters.
Result<ChipVsModel> compare_chip_with_model(const TrialSpec& chip, const std::string& model);

/// For each spike: the largest value of a trace in `duration` (s) after the spike, over the largest value between two durations and half a
/// duration before it. Returns the smallest of these ratios.
double min_jump_ratio(const StudyCurve& trace, const std::vector<double>& spikes, double duration);

/// The longest time (s) for which a trace stays above a level.
double longest_time_above(const StudyCurve& trace, double level);

}  // namespace corpuscle
