#pragma once
// Checks how the data of a dataset are stored, and that they exist. HDF5 reads data that were never written, or that are in missing files,
// as the fill value, which is 0 by default.

#include "hdf5_file.hpp"

namespace corpuscle::hdf5 {

struct StorageInfo {
    std::vector<hsize_t> chunk = {};      ///< elements of a chunk in each dimension of the dataset; empty if the dataset is not chunked
    bool has_gaps = false;                ///< true if some chunks were never written and have no fill value defined by the file's author
    std::vector<std::string> notes = {};  ///< for the user
};

/// Fails if the data are in other files, if less than half of them were written, if a chunk is too large, or if a filter is not available.
Result<StorageInfo> check_storage(hid_t dataset, const ArrayInfo&, const std::string& path);

/// True if the chunk that begins at element `offset` (an index in each dimension) was written.
bool is_chunk_written(hid_t dataset, std::span<const hsize_t> offset);

}  // namespace corpuscle::hdf5
