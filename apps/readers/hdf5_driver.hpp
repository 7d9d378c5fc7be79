#pragma once
// HDF5 file driver for the one open descriptor of the helper program. Other files that an HDF5 file names cannot be opened.

#include <hdf5.h>

namespace corpuscle::hdf5 {

inline constexpr const char* only_file_name = "file";  ///< the only name that can be opened

/// A property list for H5Fopen that reads the descriptor; negative on failure. The caller closes it.
hid_t descriptor_access(int descriptor);

}  // namespace corpuscle::hdf5
