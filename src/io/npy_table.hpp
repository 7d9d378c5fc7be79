#pragma once
// NumPy's arrays as tables: NPY, and NPZ with one of its arrays.

#include "io/table.hpp"

namespace corpuscle {

/// Rows and channels in one or two dimensions, of any kind of number; or a structure, each of its fields that is a number a column.
Result<std::unique_ptr<Table>> open_npy_table(const std::string& path, const TableOptions& = {});

/// The array asked for, or the only one. A number called rate or fs is the rate; a list called time or t with as many rows, the time.
Result<std::unique_ptr<Table>> open_npz_table(const std::string& path, const TableOptions& = {});

}  // namespace corpuscle
