#pragma once
// Runs a sweep on MPI ranks. Rank 0, the coordinator, owns the results file, distributes items and writes the outcomes; it also computes
// items. The other ranks are workers.

#include "run/ranks.hpp"
#include "sweep/parallel/run_sweep.hpp"

namespace corpuscle {

/// Workers that died or stopped responding are counted as dead, and their items are given to other ranks. A worker that only paused takes
/// part again; outcomes of items that it no longer has are ignored.
struct DeadRanks {
    int ranks = 0;                         ///< number of workers that were counted as dead, each once
    std::int64_t redistributed_items = 0;  ///< number of items that were distributed again
};

/// For rank 0: like run_sweep(), on all ranks. At the end, the other ranks end their run_worker().
Result<void> run_coordinator(Ranks&, const Sweep&, SweepResults&, const SweepRunOptions&, SweepProgress&, DeadRanks&);
/// For rank 0 if it cannot call run_coordinator(): makes the other ranks end their run_worker().
void shut_down_workers(Ranks&);

/// For any other rank: computes items until rank 0 ends the run or dies. If this rank could not read the sweep, it reports the error to
/// rank 0.
Result<void> run_worker(Ranks&, const Result<std::unique_ptr<Sweep>>&, const SweepRunOptions&);

}  // namespace corpuscle
