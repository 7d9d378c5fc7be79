#pragma once
// The results of a sweep: one SQLite file with a row for each finished item.

#include "sweep/store/results_layout.hpp"
#include "sweep/store/writer_lock.hpp"

namespace corpuscle {

/// The spelling of an item's end in the file: "done", "truncated" (at the iteration limit), "diverged".
std::string_view end_name(ItemEnd);
ItemEnd end_of_name(std::string_view);

/// The file has the following tables. A file of format 1 has other names; it can be read, but not extended or merged. The table `about`
/// contains everything on which the results depend, but neither user nor date.
///
/// - about(key, value): the metadata entries of the sweep by their names. Further keys are items (number of items of the complete sweep)
///   and metadata (names of the entries, in order). The entries trains and traces have the names of the spike trains and probes in the
///   file, trace_units the units of the probes (optional), and trace_times the times of their samples, s; the last five are JSON.
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
class SweepResults : public ResultsLayout {
public:
    /// Opens the file of this sweep for writing, and creates it if necessary. Rejects the file of another sweep, naming the first
    /// difference, and a file that another process is writing.
    static Result<SweepResults> open(const std::string& path, const SweepDescription& sweep);
    /// Opens a file for reading, also while another process writes it.
    static Result<SweepResults> open_read_only(const std::string& path);

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

    const std::string& path() const { return file_.path; }
    std::int64_t finished_count() const { return finished_; }  ///< items with a row; for a reader: when it opened the file
    const sql::Database& file() const { return file_; }        ///< for other queries
    /// The text of a metadata entry of the sweep; "" if there is none of this name.
    std::string about(std::string_view name) const;
    /// Items without a row, as ranges [first, second) in ascending order.
    Result<std::vector<std::pair<std::int64_t, std::int64_t>>> missing_ranges() const;
    /// Calls `on_row` for every row, in ascending order of items, until it returns false, with the values of the axes, and the outcome
    /// without spikes and probes.
    Result<void> for_each_row(const std::function<bool(const std::vector<double>& axes, const ItemOutcome&)>& on_row) const;
    /// Spike times of one train, s; empty if the item has none or is not finished.
    Result<std::vector<double>> spikes(std::int64_t item, std::size_t train) const;
    Result<std::vector<float>> probe_samples(std::int64_t item, std::size_t probe) const;

private:
    std::unique_ptr<WriterLock> lock_;  // null: the file was opened for reading
    sql::Database file_;
    bool is_writing_ = false;  // true after begin_writing(): the file has a -wal, to which rows are written
    sql::Statement insert_item_, insert_spikes_, insert_probe_;
    std::int64_t finished_ = 0;              // number of rows of the table items
    std::int64_t next_checkpoint_size_ = 0;  // size of the -wal for the next checkpoint, bytes

    explicit SweepResults(const std::string& path) : file_{path} {}
    /// Reads the layout from the open file.
    Result<void> read_layout();
    Result<void> count_rows();
    /// Starts the -wal and prepares the insert statements; does nothing if that is done.
    Result<void> begin_writing();
    /// Inserts the rows of one item in all tables, unless it has a row.
    Result<void> insert(const Sweep&, const ItemOutcome&);
    /// Creates a file with this layout and no items, atomically.
    Result<void> create_file() const;
    Result<void> replace_file(const std::function<Result<void>(const std::string& new_path)>& write) const;
    void remove_new_file() const;  // an incomplete one, of this run or of one that was killed
    void remove_wal() const;
    void set_next_checkpoint_size();

    std::string wal_path() const { return path() + "-wal"; }            // SQLite's write-ahead log
    std::string shared_memory_path() const { return path() + "-shm"; }  // SQLite's index of the -wal
    std::string checkpoint_path() const { return path() + "-fold"; }    // the new file, until it is complete and renamed
};

/// All rows of a results file as CSV, in order of items: a line of names, then one line for each item. The text depends only on the sweep:
/// not on shards, threads or runs. The spike times of a train, and the samples of a probe, are one field, separated by blanks. Numbers have
/// the fewest digits that read back as the same value; NaN is an empty field. `put` receives pieces of text; false stops.
Result<void> dump_results(const SweepResults&, const std::function<bool(const std::string&)>& put);

}  // namespace corpuscle
