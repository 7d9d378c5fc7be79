#pragma once
// What every file of samples is to us: named columns of numbers, read in blocks, as often as needed.

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "signal/error.hpp"

namespace corpuscle {

struct Column {
    std::string name;
    std::string unit;  ///< as the file says it; "" if it says none
    /// Why it is no channel unless it is asked for by name, as a sentence says it ("holds words"); "": it may be one.
    std::string left_out = {};
    bool stamps = false;        ///< dates or times of day, read as seconds from the first
    std::string evidence = {};  ///< of a column left out for its words: the first of them, its place, and what it should look like
};

inline constexpr std::size_t rows_a_block = 4096;

/// What a format may need to know besides the path.
struct TableOptions {
    std::optional<std::string> dataset = {};  ///< which of a file's arrays is meant: "/force/data" in HDF5, "force" in NPZ
    std::optional<bool> transpose = {};       ///< rows are channels; false: rows are samples, even if there are fewer
    std::size_t skip = 0;                     ///< lines of a file of text before its table
    /// Asked while a file that is read whole is opened; false stops it.
    std::function<bool()> keep_on = [] { return true; };
};

class Table {
protected:
    bool gaps_allowed_ = false;

public:
    virtual ~Table() = default;
    virtual const std::vector<Column>& columns() const = 0;
    /// Rows a second, if the file says it; Hz.
    virtual std::optional<double> rate() const { return {}; }
    /// Was it looked at which dimension of the array is time?
    virtual bool orientation_is_known() const { return false; }
    /// With gaps allowed a field that is no finite number reads as NaN; else it is an error that names its place.
    void allow_gaps(bool allowed) { gaps_allowed_ = allowed; }
    /// Which column is the time, if the file shows it ...
    virtual std::optional<std::size_t> time_column() const = 0;
    /// ... by its name, or only by how it runs.
    virtual bool time_is_guessed() const = 0;
    /// Reads up to `rows` rows of the columns `wanted` into out[i]; fewer than asked for only at the end.
    virtual Result<std::size_t> read(const std::vector<std::size_t>& wanted, std::size_t rows, std::vector<std::vector<double>>& out) = 0;
    virtual Result<void> rewind() = 0;
    /// What the user should know of how the file is read,
    virtual std::vector<std::string> remarks() const { return {}; }
    /// and of the time column that it shows.
    virtual std::vector<std::string> time_remarks() const { return {}; }
    /// If a new trial begins at row `row` of the last block, where time goes back: the command that makes a file of one trial. Else "".
    /// The table must be rewound after that.
    virtual std::string one_trial(std::size_t row) { return static_cast<void>(row), std::string(); }
    /// Where each row begins with a word, its name: these words. The table must be rewound after that.
    virtual Result<std::vector<std::string>> row_names() { return std::vector<std::string>(); }
    /// How much of the file has been read, 0 to 1.
    virtual double done() const = 0;
    /// Where row number `row` of the last block stands, for messages.
    virtual Place place(std::size_t row) const = 0;
};

}  // namespace corpuscle
