#pragma once
// Runs the items of a sweep on threads and writes the outcomes to its results file.

#include "sweep/parallel/item_queue.hpp"
#include "sweep/store/sweep_results.hpp"

namespace corpuscle {

/// Progress of one run of a sweep, which computes the items that the results file does not have yet.
struct SweepProgress {
    std::int64_t planned = 0;  ///< items to compute: those of the shard that had no row in the results at the start
    std::int64_t done = 0, iteration_limit = 0, diverged = 0;  ///< finished items, by how they ended
    std::int64_t steps = 0, iterations = 0, spikes = 0;        ///< sums over the finished items, see ItemOutcome
    std::int64_t ran_alone = 0;                                ///< number of items, see ItemOutcome

    std::int64_t finished() const { return done + iteration_limit + diverged; }
    void add(const ItemOutcome&);
};

struct SweepRunOptions {
    unsigned threads = 0;  ///< 0: one for each core
    Shard shard = {};
    double write_interval = 0.2;  ///< s between two writes to the results; a program that is killed loses the outcomes since the last one
    std::function<bool()> should_stop = [] { return false; };                             ///< called after each write; true stops the run
    std::function<void(const SweepProgress&)> on_progress = [](const SweepProgress&) {};  ///< called after each write
};

/// Runs the items of the shard that have no row in the results. Returns when all are finished, when stopped (error `interrupted`), or on an
/// error in the sweep or in writing. All finished items are then in the results, unless writing failed. Updates `progress` during the run.
Result<void> run_sweep(const Sweep&, SweepResults&, const SweepRunOptions&, SweepProgress& progress);

/// Computes these items on threads. Passes the outcomes to `write` every `write_interval`, until all are finished, `run` stops them (error
/// `interrupted`), or there is an error in the sweep or in `write`. The parts of a run on several ranks.
Result<void> compute_items(const Sweep&, ItemQueue, const SweepRunOptions& run,
                           const std::function<Result<void>(std::vector<ItemOutcome>&&)>& write);
/// Writes outcomes to the results, and reports the progress.
Result<void> write_outcomes(const Sweep&, SweepResults&, const SweepRunOptions&, SweepProgress&, std::vector<ItemOutcome>&&);

}  // namespace corpuscle
