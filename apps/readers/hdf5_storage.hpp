#pragma once
// How a dataset's data are stored, and whether they are there: HDF5 reads data that were never written, or lie in files that are missing,
// as its fill value, which is 0.

#include "hdf5_file.hpp"

namespace corpuscle::hdf5 {

struct Storage {
    std::vector<hsize_t> chunk = {};  ///< of the dataset's dimensions; none: in one piece
    bool has_gaps = false;            ///< some chunks were never written
    std::vector<std::string> remarks = {};
};

/// Refuses data in other files, data that were never written, and filters that are not here.
Result<Storage> storage_of(hid_t dataset, const ArrayFacts&, const std::string& path);

/// Was the chunk with this first element written?
bool is_written(hid_t dataset, std::span<const hsize_t> offset);

}  // namespace corpuscle::hdf5
