#pragma once
// The common part of the binary formats: the number of rows is known, rows are read by number, and a file may contain several arrays.

#include <cstdint>
#include <memory>
#include <span>

#include "io/table.hpp"

namespace corpuscle {

/// Properties that are known before the samples are read.
struct SamplesInfo {
    std::vector<Column> columns = {};
    std::int64_t rows = 0;
    std::optional<double> rate = {};              ///< Hz
    std::optional<std::size_t> time_column = {};  ///< the time column, if the format defines it
    std::vector<std::string> notes = {};
};

/// The location of a value in a text file: line and field.
struct FieldLocation {
    SourceLocation location;
    std::size_t field;
};

class Samples {
public:
    virtual ~Samples() = default;
    virtual const SamplesInfo& info() const = 0;
    /// The location of a value in a text file, for messages. nullopt for binary formats.
    virtual std::optional<FieldLocation> location_of(std::int64_t row, std::size_t column) const {
        return static_cast<void>(row), static_cast<void>(column), std::nullopt;
    }
    /// Reads `rows` rows, starting with row `first`, of column wanted[i] into out[i]. The rows must exist.
    virtual Result<void> fetch(std::int64_t first, std::size_t rows, std::span<const std::size_t> wanted,
                               std::vector<std::vector<double>>& out) = 0;
};

using SamplesResult = Result<std::unique_ptr<Samples>>;

/// Wraps samples as a table. Returns an error if there are no samples. A value that is not finite is an error when it is read, unless
/// gaps are allowed.
Result<std::unique_ptr<Table>> make_table(SamplesResult, const std::string& path);

/// Adds a list of times as the first column of samples with the same number of rows.
std::unique_ptr<Samples> add_time_column(std::unique_ptr<Samples> times, std::unique_ptr<Samples> samples);

/// Describes one array of a file.
struct ArrayInfo {
    std::string name;  ///< the path in HDF5
    std::vector<std::uint64_t> shape;
    bool is_numeric = false;
};

/// Name and shape: "force (12000 x 16)".
std::string describe(const ArrayInfo&);

/// The index of the array called `wanted`. By default, the index of the only array that can be a recording: numbers in one or two
/// dimensions that are neither times nor a rate. Otherwise returns an error that lists the arrays.
Result<std::size_t> choose_array(std::span<const ArrayInfo>, const std::optional<std::string>& wanted, const std::string& path);

/// True if an array, number or attribute of this name is the sample rate in Hz.
bool is_rate_name(std::string_view name);

/// The last component of a path.
std::string_view last_path_component(std::string_view path);

/// The orientation of an array. One dimension is one channel, two are rows and channels, a single row is one channel.
struct ArrayExtent {
    std::uint64_t rows = 0, columns = 1;
    bool is_transposed = false;  ///< samples run along the second dimension
    std::string note = {};       ///< the reason for a transposition
};

/// Hints that distinguish samples from channels in an array with more columns than rows.
struct ExtentHints {
    std::optional<bool> transpose = {};               ///< as requested by the user
    bool is_column_major = false;                     ///< column-major, as MATLAB writes arrays
    std::vector<std::uint64_t> time_lengths = {};     ///< lengths of time lists that may belong to the array
    std::optional<std::uint64_t> channel_names = {};  ///< number of channel names
};

/// Determines the orientation of an array. More channels than samples are an error, unless a hint resolves the orientation.
Result<ArrayExtent> extent_of(const ArrayInfo&, const std::string& path, const ExtentHints& = {});

/// The length of the array if it can be a list of times, by its name, type and shape. Otherwise nullopt.
std::optional<std::uint64_t> time_list_length(const ArrayInfo&);

/// Columns for an array. A single column has the array's name, several are called ch1, ch2 ... A unit in the array's name ("force_mN")
/// applies to all.
std::vector<Column> columns_named_after(std::string_view array, std::size_t count);

}  // namespace corpuscle
