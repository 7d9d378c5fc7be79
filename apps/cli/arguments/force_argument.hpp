#pragma once
// Opens the FORCE argument of the command line: a stimulus by name, or a recording.

#include <memory>
#include <span>
#include <string>

#include "core/force_source.hpp"
#include "core/parameter_override.hpp"
#include "io/recording/recording.hpp"

namespace corpuscle {

/// True if an argument names a stimulus ("press"), a touch of a skin ("stroke") or an existing file, or is "-" (standard input).
bool is_force(const std::string& argument);

/// Opens a stimulus or a recording. A stimulus takes precedence over a file of the same name: write ./press for the file. "-" is standard
/// input. `rate` (Hz) and `seed` are for stimuli; RecordingOptions::rate, if set, replaces `rate`.
Result<Applied<std::unique_ptr<ForceSource>>> open_force(const std::string& force, const RecordingOptions&,
                                                         std::span<const ParameterOverride> overrides, double rate, std::uint64_t seed);

}  // namespace corpuscle
