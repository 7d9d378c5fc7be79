#pragma once
// Checks how the data of a dataset are stored, and that they exist. HDF5 reads data that were never written, or that are in missing files,
// as the fill value, which is 0 by default.

#include "hdf5_file.hpp"

namespace corpuscle::hdf5 {

struct StorageInfo {
    std::vector<hsize_t> chunk = {};  ///< in each dimension of the dataset; empty: not chunked
    bool has_gaps = false;            ///< some chunks were never written
    std::vector<std::string> notes = {};
};

/// Rejects data in other files, data that were never written, and filters that are not available.
Result<StorageInfo> check_storage(hid_t dataset, const ArrayInfo&, const std::string& path);

/// True if the chunk that begins at this element was written.
bool is_chunk_written(hid_t dataset, std::span<const hsize_t> offset);

}  // namespace corpuscle::hdf5
