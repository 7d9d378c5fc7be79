#pragma once
// NumPy arrays as tables: NPY, and one array of an NPZ archive.

#include "io/table/table.hpp"

namespace corpuscle {

/// Reads the array of an NPY file. It has one or two dimensions and any real type of numbers up to 64 bits. Each numeric field of a
/// structured array is a column.
Result<std::unique_ptr<Table>> open_npy_table(const std::string& path, const TableOptions& = {});

/// Reads one array of an NPZ file: the one that the options request, otherwise the only one that can be a recording. A single number called
/// rate or fs is its sample rate in Hz. A list called time or t with as many elements as the array has rows is its time column.
Result<std::unique_ptr<Table>> open_npz_table(const std::string& path, const TableOptions& = {});

}  // namespace corpuscle
