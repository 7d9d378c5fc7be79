#pragma once
// The common interface of all recording formats: named columns of numbers, read in blocks. A table can be rewound
// and read again.

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
    std::string unit;  ///< as written in the file; "" if there is none
    /// The reason why the column is not a channel unless it is requested by name, as a predicate ("holds words"). "": it may be one.
    std::string exclusion_reason = {};
    bool holds_time_stamps = false;       ///< holds dates or times of day, which are read as seconds from the first
    std::string exclusion_evidence = {};  ///< if the column holds words: the first word, its line, and a remedy if one is known
};

inline constexpr std::size_t rows_per_block = 4096;

/// Options for opening a file.
struct TableOptions {
    std::optional<std::string> dataset = {};  ///< the array to read: "/force/data" in HDF5, "force" in NPZ
    std::optional<bool> transpose = {};       ///< true: rows are channels, false: rows are samples, even if there are fewer rows
    std::size_t skip_lines = 0;               ///< number of lines before the table in a text file
    /// Called while opening a file that must be read completely. If it returns false, reading stops.
    std::function<bool()> should_continue = [] { return true; };
};

class Table {
protected:
    bool allows_gaps_ = false;

public:
    virtual ~Table() = default;
    virtual const std::vector<Column>& columns() const = 0;
    /// The sample rate in Hz, if the file contains it.
    virtual std::optional<double> rate() const { return {}; }
    /// True if the format has determined which dimension of the array is time.
    virtual bool is_orientation_known() const { return false; }
    /// If gaps are allowed, a field that is not a finite number reads as NaN. Otherwise it is an error that names its location.
    void allow_gaps(bool allowed) { allows_gaps_ = allowed; }
    /// The time column, if one was found in the file.
    virtual std::optional<std::size_t> time_column() const = 0;
    /// True if the time column was recognised by its values instead of its name.
    virtual bool is_time_guessed() const = 0;
    /// Reads up to `rows` rows of column wanted[i] into out[i]. Returns fewer only at the end of the file.
    virtual Result<std::size_t> read(const std::vector<std::size_t>& wanted, std::size_t rows, std::vector<std::vector<double>>& out) = 0;
    virtual Result<void> rewind() = 0;
    /// Notes for the user about how the file is read.
    virtual std::vector<std::string> notes() const { return {}; }
    /// Notes for the user about the time column.
    virtual std::vector<std::string> time_notes() const { return {}; }
    /// For row `row` of the last block, where the time decreases: if a new trial begins there, how to make a file of a single trial.
    /// Otherwise "". The table must be rewound afterwards.
    virtual std::string single_trial_advice(std::size_t row) { return static_cast<void>(row), std::string(); }
    /// The names of the rows, if each row begins with a name. The table must be rewound afterwards.
    virtual Result<std::vector<std::string>> row_names() { return std::vector<std::string>(); }
    /// The fraction of the file that has been read, 0 to 1.
    virtual double progress() const = 0;
    /// The location of row number `row` of the last block, for messages.
    virtual SourceLocation location(std::size_t row) const = 0;
};

}  // namespace corpuscle
