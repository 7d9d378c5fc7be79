#pragma once
// Reads a dataset of an HDF5 file as samples. For the helper program only.

#include "io/samples.hpp"

namespace corpuscle {

/// Opens the requested dataset, or the only one that can be a recording. `path` is for messages.
SamplesResult open_hdf5_samples(int descriptor, const std::string& path, const TableOptions&);

}  // namespace corpuscle
