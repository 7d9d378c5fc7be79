#pragma once
// A sweep on ranks: rank 0 owns the file, hands out blocks of units and writes what comes back; it works, too.

#include "study/sweep/ranks.hpp"
#include "study/sweep/run_sweep.hpp"

namespace corpuscle {

/// Who became silent, or died, is taken for dead: its block goes to others. One that only slept comes back; what it did is not counted
/// twice.
struct RanksLost {
    int dead = 0;            ///< ranks
    std::int64_t units = 0;  ///< that were handed out again
};

/// Rank 0: as run_sweep. All other ranks end with it.
Result<void> lead(Ranks&, const Sweep&, SweepResults&, const SweepRun&, SweepCount&, RanksLost&);
/// Rank 0 cannot begin: the others end.
void dismiss(Ranks&);

/// Another rank: works until rank 0 says that it is over, or is gone. An error here, of a sweep that cannot be read, is told to rank 0.
Result<void> follow(Ranks&, const Result<std::unique_ptr<Sweep>>&, const SweepRun&);

}  // namespace corpuscle
