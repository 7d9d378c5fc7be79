#pragma once
// The layout of a results file: metadata, columns, names of trains and probes. Written once, when the file is created.

#include <map>

#include "study/sweep/sqlite.hpp"
#include "study/sweep/sweep.hpp"

namespace corpuscle {

struct ResultsLayout {
    static constexpr std::int64_t format = 2;                   ///< of new files; earlier ones are only read, later ones are rejected
    static constexpr std::int64_t application_id = 0x53776570;  ///< "Swep", identifies the file

    std::int64_t file_format = format;  ///< of the file that was read
    std::int64_t item_count = 0;
    std::vector<SweepColumn> axes, measures;
    std::vector<std::string> train_names, probe_names;
    std::vector<double> probe_times;
    std::vector<std::string> metadata_names;   ///< names of the metadata entries, in order
    std::map<std::string, std::string> about;  ///< all values of the table about, by key
    /// Column names of axes, then measures, in the table. A name that exists already, or that differs only in case, gets a number.
    std::vector<std::string> stored_column_names;

    static ResultsLayout of(const Sweep&);
    static Result<ResultsLayout> read(sqlite3*, const std::string& path);
    /// Creates the tables and fills about and columns; the other tables are empty.
    Result<void> write(sqlite3*, const std::string& path) const;
    bool is_current_format() const { return file_format == format; }
    /// The error for adding rows to a file of an earlier format, or merging it.
    Error read_only_format(const std::string& path) const;
    /// The first difference, as a sentence; "" if there is none.
    std::string difference_from(const ResultsLayout& other) const;
};

}  // namespace corpuscle
