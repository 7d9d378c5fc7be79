#pragma once
// Determines, from the headings and the first rows, which column is the time and which columns are not channels (row numbers, words).

#include <limits>

#include "io/table/heading.hpp"

namespace corpuscle {

/// The number of rows, from the first one on, that are inspected.
inline constexpr std::size_t inspected_rows = 64;

/// The fields of the inspected rows of one column.
struct FirstFields {
    std::vector<double> numbers;  ///< for each row; NaN for a field that is not a number
    /// Numbers of fields that are numbers, words, time stamps (dates or times of day), and empty.
    std::size_t value_count = 0, word_count = 0, stamp_count = 0, empty_count = 0;

    void add_number(double x) { numbers.push_back(x), ++value_count; }
    /// Adds a field that is not a number; `count` is one of the three other counts.
    void add_other(std::size_t& count) { numbers.push_back(std::numeric_limits<double>::quiet_NaN()), ++count; }
};

struct ColumnRoles {
    std::optional<std::size_t> time_column = {};  ///< nullopt: the table has none
    bool is_time_guessed = false;                 ///< true: the time column was recognised by its values, not by its name
    std::vector<std::string> notes = {};          ///< notes for the user about the time column
};

/// Finds the time column, and marks in `columns` those with time stamps and those that are not channels. `first` has one element for each
/// column. `named` is true if the columns have headings; without headings, only a column of time stamps can be the time. `time` is the time
/// column if the file states it.
ColumnRoles assign_roles(std::vector<Column>& columns, const std::vector<FirstFields>& first, bool named,
                         std::optional<std::size_t> time = {});

/// True if any column has a name other than the default names ch1, ch2 ...
bool has_named_columns(const std::vector<Column>& columns);

}  // namespace corpuscle
