#pragma once
// The results of a sweep: one SQLite file with a row for each item.

#include "study/sweep/sweep.hpp"

struct sqlite3;

namespace corpuscle {

struct ResultsLayout;

/// The spelling in the file: "done", "truncated", "diverged".
std::string_view end_name(ItemEnd);

/// The file has these tables. A file of format 1 has other names; it can be read, but not extended or merged. The table about
/// contains everything on which the results depend, but neither user nor date.
///
/// - about(key, value): the metadata entries by their names. Further keys are items, metadata (names of the entries in order), trains,
///   traces and trace_times, the last four as JSON.
///
/// - columns(position, kind, name, unit, description, words, at_least, at_most, stored): kind is 'axis' or 'measure', words is JSON (the
///   labels of an axis), stored is the column's name in the table items.
///
/// - items(item, ended, steps, iterations, alone, why, ...): a row for each item, with a column for each axis and measure. ended is 'done',
///   'truncated' or 'diverged'. NaN is stored as NULL.
///
/// - spikes(item, train, times): little-endian doubles. The train is an index from 0; a train without spikes has no row.
///
/// - traces(item, trace, samples): samples of the kept probes, little-endian floats. The trace is the index of the probe.
///
/// During a run new rows are in path-wal, which only grows; checkpoint() replaces the file itself atomically. So a copy of the file, with
/// or without its -wal, taken at any time, contains the first n transactions for some n.
class SweepResults {
public:
    /// Opens this sweep's file, creating it if necessary. Rejects the file of another sweep, naming the first difference, and a file that
    /// another process is writing.
    static Result<SweepResults> open(const std::string& path, const Sweep&);
    /// Opens or creates a file of the same sweep as another file.
    static Result<SweepResults> open(const std::string& path, const SweepResults& other);
    /// Opens for reading, also during a run.
    static Result<SweepResults> open_read_only(const std::string& path);
    SweepResults(SweepResults&&) noexcept;
    SweepResults& operator=(SweepResults&&) noexcept;
    ~SweepResults();

    /// Adds all of these rows, or none if the program or the disk fails; existing rows are not changed.
    Result<void> add(const Sweep&, std::vector<ItemOutcome>&&);
    /// Merges the -wal into the file. Call at the end of a run; add() also does it when the -wal has become long. If the disk is full,
    /// nothing is lost.
    Result<void> checkpoint();
    /// Returns an error if the other file is of another sweep, or one of them has an earlier format.
    Result<void> check_same_sweep(const SweepResults& other) const;
    /// Copies all rows of another file of the same sweep; returns the number of new rows. Rejects a file in which an item has different
    /// results.
    Result<std::int64_t> merge(const SweepResults& from);
    /// Records the number of items planned in this run, for other processes that read the file.
    void announce_run(std::int64_t planned) const;

    const std::string& path() const;
    std::int64_t item_count() const;      ///< of the complete sweep
    std::int64_t finished_count() const;  ///< rows
    const std::vector<SweepColumn>& axes() const;
    const std::vector<SweepColumn>& measures() const;
    const std::vector<std::string>& train_names() const;
    const std::vector<std::string>& probe_names() const;
    const std::vector<double>& probe_times() const;
    /// The value of a key in the table about; "" if there is none.
    std::string about(const std::string& key) const;
    /// Items without a row, as ranges [from, to).
    Result<std::vector<std::pair<std::int64_t, std::int64_t>>> missing_ranges() const;
    /// Column names of axes, then measures, in the table items.
    const std::vector<std::string>& stored_column_names() const;

    /// Calls `on_row` for every row in order of items, with axes and measures as in the columns; false stops.
    struct Row {
        std::int64_t item;
        ItemEnd end;
        std::int64_t steps, iterations;
        bool ran_alone;
        std::string reason;
        std::vector<double> axes, measures;
    };
    Result<void> for_each_row(const std::function<bool(const Row&)>& on_row) const;
    /// Number of rows with this end.
    Result<std::int64_t> count_ended(ItemEnd) const;
    Result<std::vector<double>> spikes(std::int64_t item, std::size_t train) const;
    Result<std::vector<float>> probe_samples(std::int64_t item, std::size_t probe) const;
    sqlite3* handle() const;  ///< for custom queries

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
    explicit SweepResults(std::unique_ptr<Impl>);
    static Result<SweepResults> open_with_layout(const std::string& path, const ResultsLayout&);
};

}  // namespace corpuscle
