#pragma once
// Transposes a table, so that its rows become channels. Used for text files; array formats transpose while they
// read.

#include "io/table.hpp"

namespace corpuscle {

/// Reads the entire table into memory, so the table must not be large. The columns are called ch1, ch2 ... unless the rows have names.
Result<std::unique_ptr<Table>> transpose_table(std::unique_ptr<Table>, const std::string& path);

}  // namespace corpuscle
