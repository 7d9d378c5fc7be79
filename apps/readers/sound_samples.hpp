#pragma once
// Reads sound files as samples with libsndfile. For the helper program only, because damaged files have crashed the library.

#include "io/recording/samples.hpp"

namespace corpuscle {

/// Opens the sound file that is open as descriptor `file`; `path` is for messages. The options are not used.
SamplesResult open_sound_samples(int file, const std::string& path, const TableOptions&);

}  // namespace corpuscle
