#pragma once
// What an open file of results holds; for results.cpp and fold.cpp.

#include "study/sweep/results.hpp"
#include "study/sweep/results_layout.hpp"
#include "study/sweep/writer_lock.hpp"

namespace corpuscle {

struct SweepResults::Held {
    std::string path;
    ResultsLayout layout;
    std::optional<WriterLock> lock;  ///< of one that writes
    sql::Handle file;
    bool writing = false;  ///< rows go into a -wal
    sql::Statement unit, spikes, trace;
    std::int64_t finished = 0;
    std::int64_t next_fold = 0;  ///< bytes of the -wal

    Result<void> open_file(int flags);
    Result<void> begin_writing();
    Result<void> put(const Sweep&, const UnitOutcome&);
    /// A file with empty tables, in its place at once.
    Result<void> make() const;
    /// The last: as a file that needs nothing beside it and no place that can be written to.
    Result<void> fold(bool last);
    void set_next_fold();

    std::string wal() const { return path + "-wal"; }
    std::string shared_memory() const { return path + "-shm"; }
    std::string folded() const { return path + "-fold"; }
};

}  // namespace corpuscle
