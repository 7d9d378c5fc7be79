#pragma once
// The options for reading a recording, which respond and stream have in common, and their conversion to options of the reader.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/arguments/option_rows.hpp"
#include "io/recording/recording.hpp"

namespace corpuscle {

/// The options as typed. Members are named after their options unless a comment says otherwise.
struct RecordingArguments {
    std::vector<std::string> channels, notch;  ///< all --channel and --notch options
    std::optional<std::string> rate, dataset, time, time_unit, unit, scale, resample, offset, range, bad_fields, despike, lowpass;
    std::string layout;
    std::optional<std::uint32_t> skip;  ///< number of lines at the beginning of a text file
    std::optional<bool> transpose;      ///< true: --transpose; false: --no-transpose
    bool absolute = false;              ///< --abs
};

/// All of these options except --rate, which means something different in each verb.
OptionGroup recording_option_group(RecordingArguments&);

/// The value of an option in SI; no value if the option was not given. Errors name the option.
Result<std::optional<double>> optional_quantity(const std::optional<std::string>& text, std::string_view unit, std::string_view option);

/// Converts the options to those of the reader.
Result<RecordingOptions> recording_options(const RecordingArguments&);

/// The options that were given, such as "--channel", without --rate.
std::vector<std::string_view> given_recording_options(const RecordingArguments&);

/// Returns an error if a recording option was given although all `forces` are stimuli.
Result<void> check_recording_arguments(const RecordingArguments&, std::span<const std::string> forces);

}  // namespace corpuscle
