#pragma once
// What a file of results says of its sweep: facts, columns, names of trains and traces. Written once, when the file is made.

#include <map>

#include "study/sweep/sqlite.hpp"
#include "study/sweep/sweep.hpp"

namespace corpuscle {

struct ResultsLayout {
    static constexpr std::int64_t format = 1;                ///< of the file; a later one is refused
    static constexpr std::int64_t application = 0x53776570;  ///< "Swep", by which the file is known

    std::int64_t units = 0;
    std::vector<SweepColumn> axes, measures;
    std::vector<std::string> trains, traces;
    std::vector<double> trace_times;
    std::vector<std::string> facts;            ///< names, in order
    std::map<std::string, std::string> about;  ///< facts and all else, by key
    /// Names of axes, then measures, as columns of the table: one that another has already, or that differs from another's by capitals
    /// alone, gets a number.
    std::vector<std::string> stored;

    static ResultsLayout of(const Sweep&);
    static Result<ResultsLayout> read(sqlite3*, const std::string& path);
    /// Makes the tables, empty.
    Result<void> write(sqlite3*, const std::string& path) const;
    /// The first in which the other differs, as a sentence; "" if in none.
    std::string differs_from(const ResultsLayout& there) const;
};

}  // namespace corpuscle
