#pragma once
// Arguments that several verbs have. A FORCE is a stimulus by name, a touch of a skin, or a recording. There are options for reading a
// recording, and options of netlists.

#include "cli/verb.hpp"
#include "io/recording/recording_options.hpp"
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
    std::string path() const { return text == "-" ? "/dev/stdin" : text; }  ///< of a recording
};

ForceArgument read_force(std::string text);

/// True if an argument names a stimulus, a touch of a skin or an existing file, or is "-" (standard input).
bool is_force(const std::string& argument);

/// The options of recording_option_group() that were given, such as "--channel".
std::vector<std::string> given_recording_options(const CommonArguments&);

/// Returns an error if a force is a setting without its --set, or if a recording option was given although all `forces` are stimuli.
Result<void> check_recording_arguments(const CommonArguments&, std::span<const ForceArgument> forces);

/// Options that apply to every netlist of the run.
struct NetlistArguments {
    std::vector<ParameterOverride> overrides;  ///< --supply, --temp, --corner and --mismatch
    std::vector<std::string> probes;           ///< of all --probe options, each of which may have several
};

/// The netlist options of respond and run.
OptionGroup netlist_options(NetlistArguments&);

}  // namespace corpuscle
