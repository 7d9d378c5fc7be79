#pragma once
// Implementation of an open results file, for sweep_results.cpp and results_checkpoint.cpp.

#include "study/sweep/results_layout.hpp"
#include "study/sweep/sweep_results.hpp"
#include "study/sweep/writer_lock.hpp"

namespace corpuscle {

struct SweepResults::Impl {
    std::string path;
    ResultsLayout layout;
    std::optional<WriterLock> lock;  ///< of a writer
    sql::Handle file;
    bool is_writing = false;  ///< rows are written to a -wal
    sql::Statement insert_item, insert_spikes, insert_probe;
    std::int64_t finished = 0;
    std::int64_t next_checkpoint_size = 0;  ///< size of the -wal for the next checkpoint, bytes

    Result<void> open_file(int flags);
    Result<void> begin_writing();
    Result<void> insert(const Sweep&, const ItemOutcome&);
    /// Creates a file with empty tables atomically.
    Result<void> create_file() const;
    /// `last`: writes a file without a -wal, which can be read in a read-only folder.
    Result<void> checkpoint(bool last);
    void set_next_checkpoint_size();

    std::string wal_path() const { return path + "-wal"; }
    std::string shared_memory_path() const { return path + "-shm"; }
    std::string checkpoint_path() const { return path + "-fold"; }
};

}  // namespace corpuscle
