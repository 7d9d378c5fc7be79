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

/// The reader's options, of whichever verb: respond and stream read a recording alike.
Result<RecordingOptions> recording_options(const RecordingWords&);

/// The first of these options that was given, such as "--channel"; "" if none was (--rate does not count).
std::string_view recording_word(const RecordingWords&);

/// An option of recordings is refused where there are only stimuli.
Result<void> check_recording_words(const RespondWords&);

}  // namespace corpuscle
