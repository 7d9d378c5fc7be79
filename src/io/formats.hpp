#pragma once
// The formats a recording may have, chosen by extension. A new one: its file here in io/, and its row in the list.

#include <span>

#include "io/hdf5_table.hpp"
#include "io/npy_table.hpp"
#include "io/table.hpp"
#include "io/text_table.hpp"
#include "io/wav_table.hpp"

namespace corpuscle {

struct Format {
    std::string_view name;
    std::string_view extensions;  ///< separated by blanks
    std::string_view sentence;
    Result<std::unique_ptr<Table>> (*open)(const std::string& path, const TableOptions&);
};

inline constexpr Format formats[] = {
    {"text", ".csv .tsv .txt .dat .lvm .gz .json .jsonl .ndjson",
     "numbers in columns: commas, tabs, semicolons or blanks; header or none; decimal point or comma; JSON; packed with gzip or not",
     open_text_table},
    {"npy", ".npy", "NumPy's array: rows and channels, or a structure with a field a column", open_npy_table},
    {"npz", ".npz", "NumPy's arrays in one file: one of them, with its rate (fs) and times (t)", open_npz_table},
    {"sound", ".wav .w64 .flac .aif .aiff .au", "a channel a column, with its rate; whole numbers are parts of full scale: say --scale",
     open_wav_table},
    {"hdf5", ".h5 .hdf5 .nwb .mat", "a dataset of HDF5: rows and channels, or members; NWB's time series; MATLAB's -v7.3", open_hdf5_table},
};

}  // namespace corpuscle
