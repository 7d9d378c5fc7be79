#pragma once
// The recording formats. The file extension selects one. To add a format, put its source file into io/table/, and declare its function and
// add its row here.

#include <span>

#include "io/table/hdf5_table.hpp"
#include "io/table/npy_table.hpp"
#include "io/table/table.hpp"
#include "io/table/wav_table.hpp"
#include "io/text/text_table.hpp"

namespace corpuscle {

struct RecordingFormat {
    std::string_view name;
    std::string_view extensions;  ///< file extensions of the format, separated by blanks
    std::string_view description;
    Result<std::unique_ptr<Table>> (*open)(const std::string& path, const TableOptions&);
};

inline constexpr RecordingFormat recording_formats[] = {
    {"text", ".csv .tsv .txt .dat .lvm .gz .json .jsonl .ndjson",
     "columns of numbers separated by commas, tabs, semicolons or blanks; header optional, decimal point or comma; JSON, gzip",
     open_text_table},
    {"npy", ".npy", "NumPy array: rows and channels, or a structured array with one field for each column", open_npy_table},
    {"npz", ".npz", "NumPy archive: one of its arrays, with its rate (fs) or times (t)", open_npz_table},
    {"sound", ".wav .w64 .flac .aif .aiff .au",
     "one column for each channel, with the rate; integers are fractions of full scale: use --scale", open_wav_table},
    {"hdf5", ".h5 .hdf5 .nwb .mat", "HDF5 dataset: rows and channels, or a compound type; NWB time series, MATLAB -v7.3", open_hdf5_table},
};

}  // namespace corpuscle
