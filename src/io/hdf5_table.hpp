#pragma once
// A dataset of an HDF5 file as a table: plain, compound, or a time series of NWB.

#include "io/table.hpp"

namespace corpuscle {

/// The dataset asked for (or the group that holds it as `data`), or the only one. Unit, rate, names of columns and NWB's conversion
/// are its attributes'; the rate may also stand in a group above it, and rate or times in datasets beside it.
Result<std::unique_ptr<Table>> open_hdf5_table(const std::string& path, const TableOptions& = {});

}  // namespace corpuscle
