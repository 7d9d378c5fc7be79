#pragma once
// A dataset of an HDF5 file as a table. Its elements are numbers or of a compound type. A group that is a time series of NWB (Neurodata
// Without Borders) is also read.

#include "io/table/table.hpp"

namespace corpuscle {

/// Reads the dataset that the options request; for a group, its member `data`. By default, reads the only dataset that can be a recording.
/// Unit, rate, column names and the conversion factor of NWB are read from its attributes. The rate may also be an attribute of a group
/// that contains the dataset. The rate or the times may also be another dataset of its group.
Result<std::unique_ptr<Table>> open_hdf5_table(const std::string& path, const TableOptions& = {});

}  // namespace corpuscle
