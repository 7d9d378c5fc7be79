#pragma once
// HDF5 file driver that reads the one file that the helper program has open, through its descriptor. Other files, to which an HDF5 file may
// link, cannot be opened.

#include <hdf5.h>

namespace corpuscle::hdf5 {

inline constexpr const char* only_file_name = "file";  ///< the only name that H5Fopen accepts with this driver

/// A file access property list with which H5Fopen reads `descriptor`; negative on failure. The caller closes the list. Only one descriptor
/// can be used at a time.
hid_t descriptor_access(int descriptor);

}  // namespace corpuscle::hdf5
