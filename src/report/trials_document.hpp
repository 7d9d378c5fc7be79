#pragma once
// The trials of a run for the report pages.

#include <nlohmann/json.hpp>

#include "run/trials/trial_collector.hpp"

namespace corpuscle {

/// The aligned force, spikes and histograms of trials of afferents on channels. `bin`: the width of the bins, s.
nlohmann::ordered_json trials_document(const TrialCollector&, double bin);

/// The aligned force of trials of a skin, and the histograms of its classes. The first groups, whose number is "classes", are the classes
/// over the complete skin; then follow the classes in each region in which an afferent fired. It has no spikes: a skin has too many.
nlohmann::ordered_json skin_trials_document(const TrialCollector&, double bin);

}  // namespace corpuscle
