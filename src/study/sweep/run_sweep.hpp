#pragma once
// Runs a sweep's items on threads and writes the outcomes to its file.

#include "study/sweep/item_queue.hpp"
#include "study/sweep/sweep_results.hpp"

namespace corpuscle {

/// Progress of a run.
struct SweepProgress {
    std::int64_t planned = 0;                                  ///< items of this run: those of its shard without a row
    std::int64_t done = 0, iteration_limit = 0, diverged = 0;  ///< finished items, by how they ended
    std::int64_t steps = 0, iterations = 0, spikes = 0, ran_alone = 0;

    std::int64_t finished() const { return done + iteration_limit + diverged; }
    void add(const ItemOutcome&);
};

struct SweepRunOptions {
    unsigned threads = 0;  ///< 0: one for each core
    Shard shard = {};
    double write_interval = 0.2;  ///< s; a program that is killed loses the outcomes since the last write
    std::function<bool()> should_stop = [] { return false; };
    std::function<void(const SweepProgress&)> on_progress = [](const SweepProgress&) {};  ///< called several times a second
};

/// Runs the missing items. Returns when all are done, when stopped, or on an error in the sweep. Finished items are then in the file,
/// unless the disk is full. `count` receives the progress.
Result<void> run_sweep(const Sweep&, SweepResults&, const SweepRunOptions&, SweepProgress& count);

}  // namespace corpuscle
