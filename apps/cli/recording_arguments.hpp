#pragma once
// Converts the recording options of the command line to options of the reader.

#include <optional>
#include <string>
#include <string_view>

#include "io/recording.hpp"
#include "verbs.hpp"

namespace corpuscle {

/// A quantity in SI, if the option was given. Errors name the option.
Result<std::optional<double>> optional_quantity(const std::optional<std::string>& text, std::string_view unit, std::string_view option);

/// The reader's options; respond and stream share them.
Result<RecordingOptions> recording_options(const RecordingArguments&);

/// The first of these options that was given, such as "--channel"; "" if none was. --rate is not counted.
std::string_view first_recording_option(const RecordingArguments&);

/// Rejects recording options if all forces are stimuli.
Result<void> check_recording_arguments(const RespondArguments&);

}  // namespace corpuscle
