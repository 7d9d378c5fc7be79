#pragma once
// Transposes a table, so that its rows become channels. Used for text files; the readers of array formats transpose by themselves.

#include "io/table/table.hpp"

namespace corpuscle {

/// Reads the entire table into memory; a table with too many numbers is an error. The columns of the new table have the names of the rows
/// of the old one; if these have none, they are called ch1, ch2 ...
Result<std::unique_ptr<Table>> transpose_table(std::unique_ptr<Table>, const std::string& path);

}  // namespace corpuscle
