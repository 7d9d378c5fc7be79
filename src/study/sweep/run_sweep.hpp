#pragma once
// A sweep's units on threads, and what they gave in its file.

#include "study/sweep/results.hpp"
#include "study/sweep/unit_queue.hpp"

namespace corpuscle {

/// How far a run has come.
struct SweepCount {
    std::int64_t to_do = 0;                       ///< units of this run: those of its shard that had no row
    std::int64_t done = 0, capped = 0, lost = 0;  ///< of them
    std::int64_t steps = 0, iterations = 0, spikes = 0, alone = 0;

    std::int64_t ended() const { return done + capped + lost; }
    void count(const UnitOutcome&);
};

struct SweepRun {
    unsigned threads = 0;  ///< 0: as many as there are cores
    Shard shard = {};
    std::function<bool()> stop = [] { return false; };
    std::function<void(const SweepCount&)> seen = [](const SweepCount&) {};  ///< several times a second
};

/// Does what is missing. It has ended when all is done, when it was told to stop, or when something was wrong; what had ended is in the
/// file then, but for what a disk would not take. `count` says how far it came.
Result<void> run_sweep(const Sweep&, SweepResults&, const SweepRun&, SweepCount& count);

}  // namespace corpuscle
