#pragma once
// NumPy arrays as tables: NPY, and one array of an NPZ archive.

#include "io/table.hpp"

namespace corpuscle {

/// Reads an array of one or two dimensions and any numeric type. Each numeric field of a structured array is a column.
Result<std::unique_ptr<Table>> open_npy_table(const std::string& path, const TableOptions& = {});

/// Reads the requested array, or the only one. A number called rate or fs is the rate. A list called time or t with the same number of
/// rows is the time.
Result<std::unique_ptr<Table>> open_npz_table(const std::string& path, const TableOptions& = {});

}  // namespace corpuscle
