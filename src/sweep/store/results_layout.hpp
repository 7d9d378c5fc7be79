#pragma once
// The layout of a results file: the sweep's description, and the names of its columns. It is written once, when the file is
// created.

#include <array>

#include "sweep/spec/sweep.hpp"
#include "sweep/store/sqlite.hpp"

namespace corpuscle {

struct ResultsLayout : SweepDescription {
    /// Format of new files. Files of earlier formats are only read, and those of later formats rejected.
    static constexpr std::int64_t format = 2;
    static constexpr std::int64_t application_id = 0x53776570;  ///< "Swep": marks an SQLite file as a results file
    /// The columns of the table items before those of the axes and measures.
    static constexpr std::array<std::string_view, 6> item_columns = {"item", "ended", "steps", "iterations", "alone", "why"};

    std::int64_t file_format = format;  ///< format of the file that was read
    /// Names of the axes, then of the measures, as columns of the table items. A name that is equal to an earlier one, except for upper and
    /// lower case, gets a number.
    std::vector<std::string> stored_column_names;

    static ResultsLayout of(const SweepDescription&);
    /// Also shows a file of an earlier format under the present names of tables and columns.
    static Result<ResultsLayout> read(const sql::Database&);
    /// Creates the tables in an empty file. Fills the tables about and columns, and leaves the others empty.
    Result<void> write(const sql::Database&) const;
    /// The columns of the table items for a statement: "item, ended, ...". Each begins with `table`, such as "i.".
    std::string columns(std::string_view table = "") const;
    /// Returns an error for a file of an earlier format, to which rows cannot be added. `path`: its path.
    Result<void> check_current_format(const std::string& path) const;
};

/// The first difference between the present sweep and that of an earlier file, as a clause for a message; "" if they are equal.
std::string difference(const SweepDescription& now, const SweepDescription& earlier);

}  // namespace corpuscle
