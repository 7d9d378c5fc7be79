#pragma once
// A dataset of an HDF5 file as a table: of numbers, of a compound type, or a time series of NWB (Neurodata Without Borders).

#include "io/table.hpp"

namespace corpuscle {

/// Reads the requested dataset (or the member `data` of the requested group), or the only dataset. Its attributes give the unit, rate,
/// column names and NWB conversion. The rate may also be an attribute of a parent group. Rate or times may be datasets of the same group.
Result<std::unique_ptr<Table>> open_hdf5_table(const std::string& path, const TableOptions& = {});

}  // namespace corpuscle
