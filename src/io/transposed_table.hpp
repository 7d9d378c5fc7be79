#pragma once
// A table turned: its rows as channels. For text, which has no other way to be read along its rows.

#include "io/table.hpp"

namespace corpuscle {

/// Reads the whole table into memory, so it must not be large; the columns are called ch1, ch2 ...
Result<std::unique_ptr<Table>> transposed(std::unique_ptr<Table>, const std::string& path);

}  // namespace corpuscle
