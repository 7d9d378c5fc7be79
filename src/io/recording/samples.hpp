#pragma once
// The common part of the binary formats. The number of rows is known before they are read, rows can be read in any order, and a file may
// contain several arrays. `path` is the path of the file, for messages.

#include <cstdint>
#include <span>

#include "io/table/heading.hpp"

namespace corpuscle {

/// Properties that are known before the samples are read. `time_column` is set if the format defines it.
struct SamplesInfo : TableInfo {
    std::int64_t rows = 0;   ///< number of rows
    bool has_roles = false;  ///< true: the reader has determined the roles of the columns; by default they follow from the numbers
};

/// The rows of a recording, which can be read in any order.
class Samples {
protected:
    SamplesInfo info_;

public:
    virtual ~Samples() = default;
    const SamplesInfo& info() const { return info_; }
    void add_note(std::string note) { info_.notes.push_back(std::move(note)); }
    void set_start(double start) { info_.start = start; }
    void set_rate(std::optional<double> rate) { info_.rate = rate; }
    /// The location of a row in the file, for messages. Without lines, the number of the row takes their place. Rows and columns count from
    /// 0.
    virtual SourceLocation location(std::int64_t row, const std::string& path) const { return {path, static_cast<long>(row) + 1}; }
    /// The error for a value that is not a finite number.
    virtual Error bad_value(std::int64_t row, std::size_t column, double value, const std::string& path) const;
    /// Reads `rows` rows of column wanted[i] into out[i], starting with row `first` (counted from 0). The rows must exist, and out[i] must
    /// have `rows` elements.
    virtual Result<void> fetch(std::int64_t first, std::size_t rows, std::span<const std::size_t> wanted,
                               std::vector<std::vector<double>>& out) = 0;
};

using SamplesResult = Result<std::unique_ptr<Samples>>;

/// Makes a table of samples. An error instead of samples is returned as it is; samples without rows or columns are an error.
Result<std::unique_ptr<Table>> make_table(SamplesResult, const std::string& path);

/// Samples with a time column before their columns. `times` has one column, and as many rows as `samples`.
std::unique_ptr<Samples> add_time_column(std::unique_ptr<Samples> times, std::unique_ptr<Samples> samples);

/// Describes one array of a file.
struct ArrayInfo {
    std::string name;                  ///< in HDF5, the path; "" for the only array of an NPY file
    std::vector<std::uint64_t> shape;  ///< length of each dimension
    bool is_numeric = false;           ///< true: the elements are numbers, or have a field that is a number
};

/// Name and shape: "force (12000 x 16)".
std::string describe(const ArrayInfo&);

/// The index of the array called `wanted`. By default, the index of the only array that can be a recording: one of numbers in one or two
/// dimensions that are neither times nor a rate. If there is no such array, or several, returns an error that lists the arrays.
Result<std::size_t> choose_array(std::span<const ArrayInfo>, const std::optional<std::string>& wanted, const std::string& path);

/// True if an array, number or attribute of this name is the sample rate in Hz.
bool is_rate_name(std::string_view name);

/// The last component of a path inside a file: "data" for "/force/data".
std::string_view last_path_component(std::string_view path);

/// The orientation of an array. An array of one dimension, or with a single row, is one channel. In other arrays of two dimensions, one
/// dimension is the samples and the other the channels.
struct ArrayExtent {
    std::uint64_t rows = 0, columns = 1;  ///< numbers of samples and of channels
    bool is_transposed = false;           ///< true: the second dimension is the samples
    std::string note = {};                ///< note for the user if the array was transposed because of a hint; otherwise ""
};

/// Hints that distinguish samples from channels in an array with more columns than rows.
struct ExtentHints {
    std::optional<bool> transpose = {};               ///< requested by the user: see TableOptions::transpose
    bool is_column_major = false;                     ///< true: the dimensions are swapped, as in arrays that MATLAB writes
    std::vector<std::uint64_t> time_lengths = {};     ///< lengths of the lists of times that may belong to the array
    std::optional<std::uint64_t> channel_names = {};  ///< number of names of channels in the file; nullopt: it has none
};

/// Determines the orientation of an array. More channels than samples are an error, unless a hint resolves the orientation.
Result<ArrayExtent> extent_of(const ArrayInfo&, const std::string& path, const ExtentHints& = {});

/// The number of elements of the array if its name, type and shape allow that it is a list of times; otherwise nullopt.
std::optional<std::uint64_t> time_list_length(const ArrayInfo&);

/// `count` columns for an array of this name. A single column has the name of the array; several are called ch1, ch2 ... A unit in the name
/// of the array ("force_mN") is the unit of all columns.
std::vector<Column> columns_named_after(std::string_view array, std::size_t count);

/// Reads the entire table into memory; a table with too many numbers is an error. The columns of the new table have the names of the rows
/// of the old one; if these have none, they are called ch1, ch2 ...
Result<std::unique_ptr<Table>> transpose_table(std::unique_ptr<Table>, const std::string& path);

}  // namespace corpuscle
