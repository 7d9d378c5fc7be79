#pragma once
// Implementation of an open results file, for sweep_results.cpp and results_checkpoint.cpp.

#include "study/sweep/results.hpp"
#include "study/sweep/results_layout.hpp"
#include "study/sweep/writer_lock.hpp"

namespace corpuscle {

struct SweepResults::Held {
    std::string path;
    ResultsLayout layout;
    std::optional<WriterLock> lock;  ///< of a writer
    sql::Handle file;
    bool writing = false;  ///< rows are written to a -wal
    sql::Statement unit, spikes, trace;
    std::int64_t finished = 0;
    std::int64_t next_fold = 0;  ///< size of the -wal for the next checkpoint, bytes

    Result<void> open_file(int flags);
    Result<void> begin_writing();
    Result<void> put(const Sweep&, const UnitOutcome&);
    /// Creates a file with empty tables atomically.
    Result<void> make() const;
    /// `last`: writes a file without a -wal, which can be read in a read-only folder.
    Result<void> fold(bool last);
    void set_next_fold();

    std::string wal() const { return path + "-wal"; }
    std::string shared_memory() const { return path + "-shm"; }
    std::string folded() const { return path + "-fold"; }
};

}  // namespace corpuscle
