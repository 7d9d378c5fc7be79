#pragma once
// The common interface of all recording formats: named columns of numbers, read in blocks of rows. A table can be rewound and read again.
// The last block is the one that the last call of Table::read() returned.

#include <cstddef>
#include <functional>
#include <vector>

#include "core/error.hpp"

namespace corpuscle {

struct Column {
    std::string name;
    std::string unit;  ///< as written in the file; "" if there is none
    /// The reason why the column is not a channel by default, as the end of a sentence ("holds words"). "": the column may be a channel.
    std::string exclusion_reason = {};
    bool holds_time_stamps = false;       ///< true: holds dates or times of day, which read() returns as seconds from the first one
    std::string exclusion_evidence = {};  ///< for a column of words in a text file: the first word, its line, and a remedy if one is known
};

/// The usual number of rows that are read at once.
inline constexpr std::size_t rows_per_block = 4096;

/// Options for opening a file.
struct TableOptions {
    std::optional<std::string> dataset = {};  ///< array to read: "/force/data" in HDF5, "force" in NPZ; nullopt: the only one
    std::optional<bool> transpose = {};       ///< true: rows are channels; false: rows are samples; nullopt: the reader decides
    std::size_t skip_lines = 0;               ///< number of lines at the beginning of a text file to ignore
    /// Called now and then while a file is opened that must be read completely for this. If it returns false, opening stops with an error.
    std::function<bool()> should_continue = [] { return true; };
};

/// Properties of a table that are known when it has been opened.
struct TableInfo {
    std::vector<Column> columns = {};
    std::optional<std::size_t> time_column = {};  ///< nullopt if the reader found none
    bool is_time_guessed = false;                 ///< true if the time column was recognised by its values, not by its name
    std::optional<double> rate = {};              ///< Hz; nullopt if the file does not state it
    double start = 0;                             ///< s, time of the first row of a table with a rate and without a time column
    bool is_orientation_known =
        true;  ///< true if the reader of the format has determined whether the rows in the file are samples or channels
    std::vector<std::string> notes = {};       ///< for the user about how the file is read
    std::vector<std::string> time_notes = {};  ///< for the user about the time column
};

class Table {
protected:
    TableInfo info_;
    bool allows_gaps_ = false;  // see allow_gaps()

public:
    virtual ~Table() = default;
    const TableInfo& info() const { return info_; }
    const std::vector<Column>& columns() const { return info_.columns; }
    /// If gaps are allowed, read() returns NaN for a field that is not a finite number. Otherwise such a field is an error at its location.
    void allow_gaps(bool allowed) { allows_gaps_ = allowed; }
    /// Reads up to `rows` rows of column wanted[i] into out[i]. Returns the number of rows read, which is smaller only at the end of the
    /// table.
    virtual Result<std::size_t> read(const std::vector<std::size_t>& wanted, std::size_t rows, std::vector<std::vector<double>>& out) = 0;
    /// Continues at the first row.
    virtual Result<void> rewind() = 0;
    /// Advice for a file in which the time decreases at row `row` of the last block. If a new trial begins there: how to read all trials, or
    /// to make a file of a single one. Otherwise "". Call rewind() before the next read().
    virtual std::string single_trial_advice(std::size_t row) { return static_cast<void>(row), std::string(); }
    /// The text of a column in every row, for columns that identify trials. Numbers are written as short as possible. Call rewind() before
    /// the next read().
    virtual Result<std::vector<std::string>> texts(std::size_t column);
    /// The names of all rows if each row begins with a name, otherwise empty. Call rewind() before the next read().
    virtual Result<std::vector<std::string>> row_names() { return std::vector<std::string>(); }
    /// The fraction of the file that has been read since rewind(), 0 to 1.
    virtual double progress() const = 0;
    /// The location in the file of row `row` (counted from 0) of the last block, for messages.
    virtual SourceLocation location(std::size_t row) const = 0;
};

}  // namespace corpuscle
