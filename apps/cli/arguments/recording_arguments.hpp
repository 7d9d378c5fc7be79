#pragma once
// The options for reading a recording, which respond and stream have in common.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/arguments/force_argument.hpp"
#include "cli/verb.hpp"

namespace corpuscle {

/// All of these options except --rate, which means something different in each verb.
OptionGroup recording_option_group(RecordingOptions&);

/// The options of this group that were given, such as "--channel".
std::vector<std::string> given_recording_options(const CommonArguments&);

/// Returns an error if a recording option was given although all `forces` are stimuli.
Result<void> check_recording_arguments(const CommonArguments&, std::span<const ForceArgument> forces);

}  // namespace corpuscle
