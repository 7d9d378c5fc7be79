#pragma once
// Determines, from headings and first rows, which column is the time and which columns are not channels (indexes, words).

#include <limits>
#include <optional>

#include "io/heading.hpp"

namespace corpuscle {

/// The number of rows that are inspected.
inline constexpr std::size_t inspected_rows = 64;

/// The first fields of a column, with a count for each kind of field.
struct FirstFields {
    std::vector<double> numbers;  ///< NaN for a field that is not a number
    std::size_t value_count = 0, word_count = 0, stamp_count = 0, empty_count = 0;

    void add_number(double x) { numbers.push_back(x), ++value_count; }
    void add_other(std::size_t& count) { numbers.push_back(std::numeric_limits<double>::quiet_NaN()), ++count; }
};

struct ColumnRoles {
    std::optional<std::size_t> time_column = {};
    bool is_time_guessed = false;         ///< recognised by its values, not by its name
    std::vector<std::string> notes = {};  ///< about the time column
};

/// Marks columns with time stamps and columns that are not channels, and finds the time column. `first` has one element for each
/// column. `named` is true if the columns have headings; otherwise only time stamps can be the time. `time` is the time column if the
/// file states it.
ColumnRoles assign_roles(std::vector<Column>& columns, const std::vector<FirstFields>& first, bool named,
                         std::optional<std::size_t> time = {});

/// True if any column has a name other than the default names ch1, ch2 ...
bool has_named_columns(const std::vector<Column>& columns);

}  // namespace corpuscle
