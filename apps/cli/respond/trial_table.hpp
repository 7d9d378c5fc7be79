#pragma once
// The responses to trials as text for a terminal.

#include "run/trials/trial_collector.hpp"

namespace corpuscle {

/// A line for each label and afferent: means and standard deviations over trials.
std::string trial_table(const TrialCollector&);

}  // namespace corpuscle
