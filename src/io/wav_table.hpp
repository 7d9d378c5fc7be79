#pragma once
// Sound files as tables, through libsndfile: every channel a column, the rate from the file.

#include "io/table.hpp"

namespace corpuscle {

/// Whole numbers are read as parts of full scale, from -1 to 1; floats as they stand.
Result<std::unique_ptr<Table>> open_wav_table(const std::string& path, const TableOptions& = {});

}  // namespace corpuscle
