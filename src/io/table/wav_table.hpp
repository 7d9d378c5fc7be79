#pragma once
// Sound files as tables, read by libsndfile: one column for each channel, and the rate of the file.

#include "io/table/table.hpp"

namespace corpuscle {

/// Opens a sound file. Integer samples are read as fractions of full scale, from -1 to 1. Floating-point samples are unchanged.
Result<std::unique_ptr<Table>> open_wav_table(const std::string& path, const TableOptions& = {});

}  // namespace corpuscle
