#pragma once
// The options of trials, for the command line.

#include "core/text/option.hpp"
#include "run/trials/aligned_trial.hpp"

namespace corpuscle {

OptionGroup trial_option_group(TrialOptions&);

/// Returns an error for options that exclude each other, or that need another one.
Result<void> check_trial_options(const TrialOptions&);

}  // namespace corpuscle
