#pragma once
// Converts the recording options of the command line to options of the reader.

#include <optional>
#include <string>
#include <string_view>

#include "cli/verbs.hpp"
#include "io/recording/recording.hpp"

namespace corpuscle {

/// The value of an option in SI; no value if the option was not given. Errors name the option.
Result<std::optional<double>> optional_quantity(const std::optional<std::string>& text, std::string_view unit, std::string_view option);

/// Converts the recording options, which respond and stream have in common, to options of the reader.
Result<RecordingOptions> recording_options(const RecordingArguments&);

/// The first recording option that was given, such as "--channel"; "" if none was. --rate is not considered.
std::string_view first_recording_option(const RecordingArguments&);

/// Returns an error if a recording option was given although all forces are stimuli.
Result<void> check_recording_arguments(const RespondArguments&);

}  // namespace corpuscle
