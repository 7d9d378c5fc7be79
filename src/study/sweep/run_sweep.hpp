#pragma once
// Runs a sweep's items on threads and writes the outcomes to its file.

#include "study/sweep/results.hpp"
#include "study/sweep/unit_queue.hpp"

namespace corpuscle {

/// Progress of a run.
struct SweepCount {
    std::int64_t to_do = 0;                       ///< items of this run: those of its shard without a row
    std::int64_t done = 0, capped = 0, lost = 0;  ///< items by their end
    std::int64_t steps = 0, iterations = 0, spikes = 0, alone = 0;

    std::int64_t ended() const { return done + capped + lost; }
    void count(const UnitOutcome&);
};

struct SweepRun {
    unsigned threads = 0;  ///< 0: one for each core
    Shard shard = {};
    double between_writes = 0.2;  ///< s; a program that is killed loses the outcomes since the last write
    std::function<bool()> stop = [] { return false; };
    std::function<void(const SweepCount&)> seen = [](const SweepCount&) {};  ///< called several times a second
};

/// Runs the missing items. Returns when all are done, when stopped, or on an error in the sweep. Finished items are then in the file,
/// unless the disk is full. `count` receives the progress.
Result<void> run_sweep(const Sweep&, SweepResults&, const SweepRun&, SweepCount& count);

}  // namespace corpuscle
