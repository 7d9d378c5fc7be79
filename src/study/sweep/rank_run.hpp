#pragma once
// A sweep on MPI ranks. Rank 0 owns the file, distributes blocks of items and writes the outcomes; it computes items as well.

#include "study/sweep/ranks.hpp"
#include "study/sweep/run_sweep.hpp"

namespace corpuscle {

/// Ranks that died or stopped responding are counted as dead and their blocks are distributed again. A rank that only paused can return;
/// its duplicate outcomes are not counted twice.
struct RanksLost {
    int dead = 0;            ///< ranks
    std::int64_t units = 0;  ///< distributed again
};

/// Rank 0: like run_sweep. All other ranks end with it.
Result<void> lead(Ranks&, const Sweep&, SweepResults&, const SweepRun&, SweepCount&, RanksLost&);
/// Rank 0 cannot start: makes the other ranks end.
void dismiss(Ranks&);

/// Any other rank: works until rank 0 ends the run or disappears. An error in reading the sweep is reported to rank 0.
Result<void> follow(Ranks&, const Result<std::unique_ptr<Sweep>>&, const SweepRun&);

}  // namespace corpuscle
