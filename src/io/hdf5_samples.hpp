#pragma once
// A dataset of an HDF5 file as samples. To be called in a helper process only.

#include "io/samples.hpp"

namespace corpuscle {

SamplesResult open_hdf5_samples(const std::string& path, const std::optional<std::string>& dataset);

}  // namespace corpuscle
