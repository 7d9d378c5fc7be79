#pragma once
// Reads a dataset of an HDF5 file as samples. For the helper program only.

#include "io/recording/samples.hpp"

namespace corpuscle {

/// Opens, in the file that is open as `descriptor`, the dataset that the options request, or the only one that can be a recording. `path`
/// is for messages.
SamplesResult open_hdf5_samples(int descriptor, const std::string& path, const TableOptions&);

}  // namespace corpuscle
