// The list of recording formats. To add one, put its source file into io/table/, and its function and its row below.

#include "io/recording/recording_formats.hpp"

namespace corpuscle {
namespace {

constexpr RecordingFormat all_formats[] = {
    {"text", ".csv .tsv .txt .dat .lvm .gz .json .jsonl .ndjson",
     "columns of numbers separated by commas, tabs, semicolons or blanks; header optional, decimal point or comma; JSON, gzip",
     open_text_table},
    {"npy", ".npy", "NumPy array: rows and channels, or a structured array with one field for each column", open_npy_table},
    {"npz", ".npz", "NumPy archive: one of its arrays, with its rate (fs) or times (t)", open_npz_table},
    {"sound", ".wav .w64 .flac .aif .aiff .au",
     "one column for each channel, with the rate; integers are fractions of full scale: use --scale", open_wav_table},
    {"hdf5", ".h5 .hdf5 .nwb .mat", "HDF5 dataset: rows and channels, or a compound type; NWB time series, MATLAB -v7.3", open_hdf5_table},
};

}  // namespace

constinit const std::span<const RecordingFormat> recording_formats = all_formats;

}  // namespace corpuscle
