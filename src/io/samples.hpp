#pragma once
// What binary files of samples have in common: rows that are counted and fetched by number, one table of several in a file.

#include <cstdint>
#include <memory>
#include <span>

#include "io/table.hpp"

namespace corpuscle {

/// What is known of samples before they are read.
struct SamplesFacts {
    std::vector<Column> columns = {};
    std::int64_t rows = 0;
    std::optional<double> rate = {};       ///< Hz
    std::optional<std::size_t> time = {};  ///< the column, if not by its name
    std::vector<std::string> remarks = {};
};

/// Where a reading stands in a file of text: which field of which line.
struct FieldPlace {
    Place place;
    std::size_t field;
};

class Samples {
public:
    virtual ~Samples() = default;
    virtual const SamplesFacts& facts() const = 0;
    virtual std::optional<FieldPlace> place_of(std::int64_t row, std::size_t column) const {
        return static_cast<void>(row), static_cast<void>(column), std::nullopt;
    }
    /// `rows` rows from number `first` on, of column wanted[i] into out[i]. All of them are there.
    virtual Result<void> fetch(std::int64_t first, std::size_t rows, std::span<const std::size_t> wanted,
                               std::vector<std::vector<double>>& out) = 0;
};

using SamplesResult = Result<std::unique_ptr<Samples>>;

/// The samples as a table; refuses none at all, and on reading what is no finite number.
Result<std::unique_ptr<Table>> table_of(SamplesResult, const std::string& path);

/// A list of times beside samples with as many rows, as the first column.
std::unique_ptr<Samples> with_times(std::unique_ptr<Samples> times, std::unique_ptr<Samples> samples);

/// An array in a file of several.
struct ArrayFacts {
    std::string name;  ///< in HDF5 the path
    std::vector<std::uint64_t> shape;
    bool numeric = false;
};

/// "force (12000 x 16)"
std::string described(const ArrayFacts&);

/// The array by name, or the only one that can be a recording: numbers in one or two dimensions that are neither times nor a rate.
/// Else an error that lists them.
Result<std::size_t> choose_array(std::span<const ArrayFacts>, const std::optional<std::string>& wanted, const std::string& path);

/// Is an array, a number or an attribute of this name the rate of sampling, in Hz?
bool names_rate(std::string_view name);

/// The last part of a path.
std::string_view last_name(std::string_view path);

/// How an array lies: one dimension is one channel, two are rows and channels; a single row is a channel lying down.
struct Extent {
    std::uint64_t rows = 0, columns = 1;
    bool lying = false;       ///< rows run along the second dimension
    std::string remark = {};  ///< if it was turned, why
};

/// What tells samples from channels in an array of more columns than rows.
struct ExtentHints {
    std::optional<bool> transpose = {};          ///< as asked
    bool by_columns = false;                     ///< the writer's rows are the second dimension (MATLAB's)
    std::vector<std::uint64_t> samples = {};     ///< lengths of the lists of times that may belong to it
    std::optional<std::uint64_t> channels = {};  ///< how many channels are named
};

/// More channels than samples are refused, unless a hint says which is which.
Result<Extent> extent_of(const ArrayFacts&, const std::string& path, const ExtentHints& = {});

/// Can an array be a list of times: of this name, numbers in one dimension? Its length, then.
std::optional<std::uint64_t> length_of_times(const ArrayFacts&);

/// Names for the columns of an array: its own if it has only one, else ch1, ch2 ...; the unit behind its name ("force_mN") is theirs.
std::vector<Column> columns_named_after(std::string_view array, std::size_t count);

}  // namespace corpuscle
