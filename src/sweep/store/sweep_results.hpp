#pragma once
// The results of a sweep: one SQLite file with a row for each finished item.

#include "sweep/spec/sweep.hpp"

struct sqlite3;

namespace corpuscle {

struct ResultsLayout;

/// The spelling of an item's end in the file: "done", "truncated" (at the iteration limit), "diverged".
std::string_view end_name(ItemEnd);

/// The file has the following tables. A file of format 1 has other names; it can be read, but not extended or merged. The table `about`
/// contains everything on which the results depend, but neither user nor date.
///
/// - about(key, value): the metadata entries of the sweep by their names. Further keys are items (number of items of the complete sweep),
///   metadata (names of the entries, in order), trains, traces (names of the spike trains and probes in the file) and trace_times (times of
///   the probes' samples, s), the last four as JSON.
///
/// - columns(position, kind, name, unit, description, words, at_least, at_most, stored): rows for the axes, then for the measures. The
///   kind is 'axis' or 'measure'. The words are the labels of an axis, as JSON. The limits of a measure are at_least and at_most. The
///   column `stored` is the name in the table items.
///
/// - items(item, ended, steps, iterations, alone, why, ...): a row for each finished item, see ItemOutcome, with a column for each axis and
///   measure. item counts from 0, ended is 'done', 'truncated' or 'diverged'. NaN is stored as NULL.
///
/// - spikes(item, train, times): spike times, s, as little-endian doubles. train is the index of the train, from 0. A train without
///   spikes has no row.
///
/// - traces(item, trace, samples): samples of a probe, as little-endian floats. trace is the index of the probe, from 0.
///
/// During a run, new rows are in SQLite's write-ahead log, a second file PATH-wal, which only grows; checkpoint() replaces PATH itself
/// atomically. So a copy of the file, with or without its -wal, taken at any time, contains the first n calls of add(), for some n.
class SweepResults {
public:
    /// Opens the file of this sweep for writing, and creates it if necessary. Rejects the file of another sweep, naming the first
    /// difference, and a file that another process is writing.
    static Result<SweepResults> open(const std::string& path, const Sweep&);
    /// Opens or creates a file for the same sweep as `other`, for writing.
    static Result<SweepResults> open(const std::string& path, const SweepResults& other);
    /// Opens a file for reading, also while another process writes it.
    static Result<SweepResults> open_read_only(const std::string& path);
    SweepResults(SweepResults&&) noexcept;
    SweepResults& operator=(SweepResults&&) noexcept;
    ~SweepResults();

    /// Adds rows for all these outcomes, or none if the program or the disk fails. Items that have a row already are left out.
    Result<void> add(const Sweep&, std::vector<ItemOutcome>&&);
    /// Moves the rows from the -wal to the file. Call at the end of a run; add() also does it when the -wal has become long. If the disk is
    /// full, nothing is lost.
    Result<void> checkpoint();
    /// Returns an error if the other file is of another sweep, or one of the two files has an earlier format.
    Result<void> check_same_sweep(const SweepResults& other) const;
    /// Copies the rows that this file lacks from another file of the same sweep; returns their number. Rejects a file in which an item has
    /// other results than in this file.
    Result<std::int64_t> merge(const SweepResults& from);
    /// Records the number of items that this run is to compute, in the lock file, for other processes that show its progress.
    void announce_run(std::int64_t planned_items) const;

    const std::string& path() const;
    std::int64_t item_count() const;      ///< of the complete sweep
    std::int64_t finished_count() const;  ///< items with a row; for a reader: when it opened the file
    const std::vector<SweepColumn>& axes() const;
    const std::vector<SweepColumn>& measures() const;
    const std::vector<std::string>& train_names() const;
    const std::vector<std::string>& probe_names() const;
    const std::vector<double>& probe_times() const;
    /// The value of a key in the table about; "" if the table does not have the key.
    std::string about(const std::string& key) const;
    /// Items without a row, as ranges [first, second) in ascending order.
    Result<std::vector<std::pair<std::int64_t, std::int64_t>>> missing_ranges() const;
    /// Names of the axes, then of the measures, as columns of the table items.
    const std::vector<std::string>& stored_column_names() const;

    /// A row of the table items. The values are in the order of axes() and measures(); NaN: no value. For the others, see ItemOutcome.
    struct Row {
        std::int64_t item;
        ItemEnd end;
        std::int64_t steps, iterations;
        bool ran_alone;
        std::string reason;
        std::vector<double> axes, measures;
    };
    /// Calls `on_row` for every row, in ascending order of items, until it returns false.
    Result<void> for_each_row(const std::function<bool(const Row&)>& on_row) const;
    /// Number of items that ended in this way.
    Result<std::int64_t> count_ended(ItemEnd) const;
    /// Spike times of one train, s; empty if the item has none or is not finished.
    Result<std::vector<double>> spikes(std::int64_t item, std::size_t train) const;
    Result<std::vector<float>> probe_samples(std::int64_t item, std::size_t probe) const;
    sqlite3* handle() const;  ///< for other queries

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
    explicit SweepResults(std::unique_ptr<Impl>);
    static Result<SweepResults> open_with_layout(const std::string& path, const ResultsLayout&);
};

}  // namespace corpuscle
