#pragma once
// A sweep on MPI ranks. Rank 0 owns the file, distributes blocks of items and writes the outcomes; it computes items as well.

#include "study/sweep/ranks.hpp"
#include "study/sweep/run_sweep.hpp"

namespace corpuscle {

/// Ranks that died or stopped responding are counted as dead, and their items are distributed to other ranks. A rank that only paused can
/// return; its duplicate outcomes are not counted twice.
struct DeadRanks {
    int ranks = 0;                         ///< number of dead ranks
    std::int64_t redistributed_items = 0;  ///< items that were distributed again
};

/// For rank 0: like run_sweep. All other ranks end with it.
Result<void> run_coordinator(Ranks&, const Sweep&, SweepResults&, const SweepRunOptions&, SweepProgress&, DeadRanks&);
/// For rank 0 if it cannot start: makes the other ranks end.
void shut_down_workers(Ranks&);

/// For any other rank: computes items until rank 0 ends the run or disappears. An error in reading the sweep is reported to rank 0.
Result<void> run_worker(Ranks&, const Result<std::unique_ptr<Sweep>>&, const SweepRunOptions&);

}  // namespace corpuscle
