#pragma once
// Reads sound files as samples with libsndfile. For the helper program only: damaged files have crashed the library before.

#include "io/samples.hpp"

namespace corpuscle {

SamplesResult open_sound_samples(int file, const std::string& path, const TableOptions&);

}  // namespace corpuscle
