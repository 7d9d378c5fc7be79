#pragma once
// Which column of a table is the time and which are no channels (indexes, words), by their headings and first rows.

#include <limits>
#include <optional>

#include "io/heading.hpp"

namespace corpuscle {

/// How many rows are looked at.
inline constexpr std::size_t rows_looked_at = 64;

/// What stands in the first rows of a column.
struct FirstFields {
    std::vector<double> numbers;  ///< NaN where there is none
    std::size_t values = 0, words = 0, stamps = 0, nothing = 0;

    void add_number(double x) { numbers.push_back(x), ++values; }
    void add_other(std::size_t& kind) { numbers.push_back(std::numeric_limits<double>::quiet_NaN()), ++kind; }
};

struct ColumnRoles {
    std::optional<std::size_t> time = {};
    bool time_is_guessed = false;           ///< by how it runs, not by its name
    std::vector<std::string> remarks = {};  ///< of the time
};

/// Marks the columns that hold stamps or are to be left out, and finds the time. `first`: a member a column. `named`: the columns have
/// headings; without them the time is not looked for but among stamps. `time`: the file itself says which column that is.
ColumnRoles assign_roles(std::vector<Column>& columns, const std::vector<FirstFields>& first, bool named,
                         std::optional<std::size_t> time = {});

/// Whether columns have names that their file gave them: they are not ch1, ch2 ...
bool are_named(const std::vector<Column>& columns);

}  // namespace corpuscle
