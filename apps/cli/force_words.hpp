#pragma once
// What is said of a force on the command line, as a source: a stimulus by name, or a recording.

#include <memory>
#include <span>
#include <string>

#include "io/recording.hpp"
#include "signal/settings.hpp"
#include "signal/source.hpp"

namespace corpuscle {

/// Whether a word of the command line is a stimulus, a touch by name or a recording that is there.
bool is_force(const std::string& word);

/// A stimulus by name goes before a file of that name; ./press is the file, - is standard input. `rate`: of a stimulus, Hz, if nobody
/// says another.
Result<std::unique_ptr<Source>> open_force(const std::string& force, const RecordingOptions&, std::span<const Wish> wishes, double rate,
                                           std::uint64_t seed);

}  // namespace corpuscle
