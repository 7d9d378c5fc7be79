#pragma once
// Implementation of an open results file, for sweep_results.cpp, merge_results.cpp and results_checkpoint.cpp.

#include "sweep/store/results_layout.hpp"
#include "sweep/store/sweep_results.hpp"
#include "sweep/store/writer_lock.hpp"

namespace corpuscle {

struct SweepResults::Impl {
    std::string path;
    ResultsLayout layout;
    std::unique_ptr<WriterLock> lock;  ///< null: the file was opened for reading
    sql::Handle file;
    bool is_writing = false;  ///< true after begin_writing(): the file has a -wal, to which rows are written
    sql::Statement insert_item, insert_spikes, insert_probe;
    std::int64_t finished = 0;              ///< number of rows of the table items
    std::int64_t next_checkpoint_size = 0;  ///< size of the -wal for the next checkpoint, bytes

    Result<void> open_file(int flags);
    /// Starts the -wal and prepares the insert statements; does nothing if that is done.
    Result<void> begin_writing();
    /// Inserts the rows of one item in all tables, unless it has a row.
    Result<void> insert(const Sweep&, const ItemOutcome&);
    /// Creates a file with `layout` and no items, atomically.
    Result<void> create_file() const;
    /// Moves the rows from the -wal to the file, by replacing the file.
    Result<void> checkpoint();
    Result<void> replace_file(const std::function<Result<void>(const std::string& new_path)>& write) const;
    void remove_new_file() const;  ///< an incomplete one, of this run or of one that was killed
    void remove_wal() const;
    void set_next_checkpoint_size();

    std::string wal_path() const { return path + "-wal"; }            ///< SQLite's write-ahead log
    std::string shared_memory_path() const { return path + "-shm"; }  ///< SQLite's index of the -wal
    std::string checkpoint_path() const { return path + "-fold"; }    ///< the new file, until it is complete and renamed
};

}  // namespace corpuscle
