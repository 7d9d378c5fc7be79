#pragma once
// The results of a sweep: one SQLite file, a row a unit.

#include "study/sweep/sweep.hpp"

struct sqlite3;

namespace corpuscle {

struct ResultsLayout;

/// As it stands in the file: "done", "capped", "lost".
std::string_view word_of(UnitEnd);

/// Tables: about(key, value): what results depend on, nothing of who ran it or when: the facts by their names, and units, facts (their
/// names in order), trains, traces, trace_times, the last four as JSON; columns(position, kind 'axis' or 'measure', name, unit, sentence,
/// words as JSON, at_least, at_most, stored: its name in units); units(unit, ended, steps, iterations, alone, why, a column for each axis
/// and measure), ended 'done', 'capped' or 'lost', NaN nothing; spikes(unit, train, times) and traces(unit, trace, samples) of
/// little-endian doubles and floats, train and trace counted from 0; a train without spikes has no row.
///
/// While somebody writes, what is new stands in path-wal, which only grows; the file itself is replaced as a whole, by fold(). So a copy of
/// it, with or without its -wal, taken at any moment, holds all that some of its transactions, from the first on, have put there.
class SweepResults {
public:
    /// The file of this sweep, made if it is not there; refuses the file of another (the first fact that differs is named) and one that
    /// another process writes.
    static Result<SweepResults> open(const std::string& path, const Sweep&);
    /// The file of the sweep that another file is of.
    static Result<SweepResults> open(const std::string& path, const SweepResults& like);
    /// To be looked at: also while somebody writes.
    static Result<SweepResults> look(const std::string& path);
    SweepResults(SweepResults&&) noexcept;
    SweepResults& operator=(SweepResults&&) noexcept;
    ~SweepResults();

    /// All of these or, if the program or the disk fails, none; what is there already is left as it is.
    Result<void> add(const Sweep&, std::vector<UnitOutcome>&&);
    /// Makes one file of it, without a -wal beside it. At the end of a run; add() does so, too, when the -wal has become long. If the disk
    /// has no room for that, nothing is lost.
    Result<void> fold();
    /// Refuses the file of another sweep than that one's.
    Result<void> same_sweep(const SweepResults& as) const;
    /// All rows of another file of the same sweep; how many were new. Refuses those of a file in which a unit has other results than here.
    Result<std::int64_t> take(const SweepResults& from);
    /// Says to those who look how much this run is to do.
    void note(std::int64_t to_do) const;

    const std::string& path() const;
    std::int64_t units() const;     ///< of the whole sweep
    std::int64_t finished() const;  ///< rows
    const std::vector<SweepColumn>& axes() const;
    const std::vector<SweepColumn>& measures() const;
    const std::vector<std::string>& trains() const;
    const std::vector<std::string>& traces() const;
    const std::vector<double>& trace_times() const;
    /// What is said of the sweep under this key; "" if nothing is.
    std::string about(const std::string& key) const;
    /// Those that have no row yet: as ranges [from, to).
    Result<std::vector<std::pair<std::int64_t, std::int64_t>>> missing() const;
    /// The names that axes, then measures, have as columns of the table units.
    const std::vector<std::string>& stored() const;

    /// Every row, in order of unit: `see` gets the unit, its end, axes and measures as in the columns; false stops.
    struct Row {
        std::int64_t unit;
        UnitEnd end;
        std::int64_t steps, iterations;
        bool alone;
        std::string why;
        std::vector<double> axes, measures;
    };
    Result<void> each(const std::function<bool(const Row&)>& see) const;
    /// Rows that ended in this way.
    Result<std::int64_t> ended(UnitEnd) const;
    Result<std::vector<double>> spikes(std::int64_t unit, std::size_t train) const;
    Result<std::vector<float>> trace(std::int64_t unit, std::size_t trace) const;
    sqlite3* handle() const;  ///< for questions of one's own

private:
    struct Held;
    std::unique_ptr<Held> held_;
    explicit SweepResults(std::unique_ptr<Held>);
    static Result<SweepResults> open_as(const std::string& path, const ResultsLayout&);
};

}  // namespace corpuscle
