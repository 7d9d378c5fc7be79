#pragma once
// HDF5's access to the one open file of the helper program: whatever other name the library is given by a file, it cannot be opened.

#include <hdf5.h>

namespace corpuscle::hdf5 {

inline constexpr const char* the_file = "file";  ///< the only name that opens

/// A property list for H5Fopen that reads the descriptor; below zero on failure. The caller closes it.
hid_t access_to(int descriptor);

}  // namespace corpuscle::hdf5
