#pragma once
// What is said of recordings on the command line, as options of the reader.

#include <optional>
#include <string>
#include <string_view>

#include "io/recording.hpp"
#include "verbs.hpp"

namespace corpuscle {

/// A quantity in SI, if it was said; errors name the option.
Result<std::optional<double>> quantity(const std::optional<std::string>& text, std::string_view unit, std::string_view option);

Result<RecordingOptions> recording_options(const RespondWords&);

/// What is said of recordings must find one.
Result<void> check_recording_words(const RespondWords&);

}  // namespace corpuscle
