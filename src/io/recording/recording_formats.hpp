#pragma once
// The recording formats. The file extension selects one. Their list is in recording_formats.cpp.

#include <span>

#include "io/table/table.hpp"

namespace corpuscle {

/// Skips blank lines, lines that begin with # or %, and a preamble, whose lines differ from rows in their number of fields or their
/// separator. The line above the rows is the header if at least one of its fields is not a number. A row of units may follow it. A comment
/// with as many fields as the rows can also be the header. The time column is found by its name, unit or time stamps (assign_roles() in
/// heading.hpp). Without a header, the first of several columns is the time if it increases in similar steps over the first rows.
Result<std::unique_ptr<Table>> open_text_table(const std::string& path, const TableOptions& = {});

/// Reads the array of an NPY file. It has one or two dimensions and any real type of numbers up to 64 bits. Each numeric field of a
/// structured array is a column.
Result<std::unique_ptr<Table>> open_npy_table(const std::string& path, const TableOptions& = {});

/// Reads one array of an NPZ file: the one that the options request, otherwise the only one that can be a recording. A single number called
/// rate or fs is its sample rate in Hz. A list called time or t with as many elements as the array has rows is its time column.
Result<std::unique_ptr<Table>> open_npz_table(const std::string& path, const TableOptions& = {});

/// Opens a sound file. Integer samples are read as fractions of full scale, from -1 to 1. Floating-point samples are unchanged.
Result<std::unique_ptr<Table>> open_wav_table(const std::string& path, const TableOptions& = {});

/// Reads the dataset that the options request; for a group, its member `data`. By default, reads the only dataset that can be a recording.
/// Unit, rate, column names and the conversion factor of NWB are read from its attributes. The rate may also be an attribute of a group
/// that contains the dataset. The rate or the times may also be another dataset of its group.
Result<std::unique_ptr<Table>> open_hdf5_table(const std::string& path, const TableOptions& = {});

struct RecordingFormat {
    std::string_view name;
    std::string_view extensions;  ///< file extensions of the format, separated by blanks
    std::string_view description;
    Result<std::unique_ptr<Table>> (*open)(const std::string& path, const TableOptions&);
};

extern const std::span<const RecordingFormat> recording_formats;

}  // namespace corpuscle
