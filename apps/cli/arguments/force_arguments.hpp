#pragma once
// A FORCE of the command line: a stimulus by name, a touch of a skin, or a recording; and the options for reading a recording, which
// respond and stream have in common.

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/verb.hpp"
#include "core/force_source.hpp"
#include "core/parameter_override.hpp"
#include "io/recording/recording.hpp"
#include "skin/contact/contact.hpp"

namespace corpuscle {

/// A FORCE as typed. A stimulus takes precedence over a file of the same name: write ./press for the file. "-" is standard input.
struct ForceArgument {
    std::string text;
    bool is_stimulus = false;           ///< "press", "press+noise"; otherwise a recording
    const NamedTouch* touch = nullptr;  ///< for a skin, the touch of this name: "stroke"; null: there is none

    /// Opens the stimulus or recording. `rate` (Hz) and `seed` are for stimuli; RecordingOptions::rate, if set, replaces `rate`.
    Result<Applied<std::unique_ptr<ForceSource>>> open(const RecordingOptions&, std::span<const ParameterOverride>, double rate,
                                                       std::uint64_t seed) const;
};

ForceArgument read_force(std::string text);

/// True if an argument names a stimulus, a touch of a skin or an existing file, or is "-" (standard input).
bool is_force(const std::string& argument);

/// The options for reading a recording, except --rate, which means something different in each verb.
OptionGroup recording_option_group(RecordingOptions&);

/// The options of this group that were given, such as "--channel".
std::vector<std::string> given_recording_options(const CommonArguments&);

/// Returns an error if a recording option was given although all `forces` are stimuli.
Result<void> check_recording_arguments(const CommonArguments&, std::span<const ForceArgument> forces);

}  // namespace corpuscle
