#pragma once
// The layout of a results file: the sweep's metadata, the columns, the names of trains and probes. It is written once, when the file is
// created.

#include <array>
#include <map>

#include "sweep/spec/sweep.hpp"
#include "sweep/store/sqlite.hpp"

namespace corpuscle {

struct ResultsLayout {
    /// Format of new files. Files of earlier formats are only read, and those of later formats rejected.
    static constexpr std::int64_t format = 2;
    static constexpr std::int64_t application_id = 0x53776570;  ///< "Swep": marks an SQLite file as a results file

    std::int64_t file_format = format;  ///< format of the file that was read
    std::int64_t item_count = 0;
    std::vector<SweepColumn> axes, measures;
    std::vector<std::string> train_names, probe_names;
    std::vector<double> probe_times;
    std::vector<std::string> metadata_names;   ///< names of the metadata entries, in order
    std::map<std::string, std::string> about;  ///< the metadata entries by name; after read(), all values of the table about by key
    /// Names of the axes, then of the measures, as columns of the table items. A name that is equal to an earlier one, except for upper and
    /// lower case, gets a number.
    std::vector<std::string> stored_column_names;

    /// The columns of the table items before those of the axes and measures.
    static constexpr std::array<std::string_view, 6> item_columns = {"item", "ended", "steps", "iterations", "alone", "why"};

    static ResultsLayout of(const Sweep&);
    /// Also shows a file of an earlier format under the present names of tables and columns.
    static Result<ResultsLayout> read(sqlite3*, const std::string& path);
    /// Creates the tables in an empty file. Fills the tables about and columns, and leaves the others empty.
    Result<void> write(sqlite3*, const std::string& path) const;
    /// The columns of the table items for a statement: "item, ended, ...". Each begins with `table`, such as "i.".
    std::string columns(std::string_view table = "") const;
    bool is_current_format() const { return file_format == format; }
    /// The error of adding rows to a file of an earlier format, or merging it.
    Error read_only_format(const std::string& path) const;
    /// The first difference between this layout, of the present sweep, and that of an earlier file, as a clause for a message; "" if they
    /// are equal.
    std::string difference_from(const ResultsLayout& earlier) const;
};

}  // namespace corpuscle
