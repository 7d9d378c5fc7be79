#pragma once
// How far a sweep is.

#include "sweep/parallel/run_sweep.hpp"

namespace corpuscle {

struct SweepStatus {
    std::string sweep, results;  ///< paths of the sweep file, "" if unknown, and of the results file
    Shard shard;
    std::int64_t items = 0;                    ///< number of work items of the shard
    std::int64_t finished = 0;                 ///< number of finished items, including the following two
    std::int64_t truncated = 0, diverged = 0;  ///< number of items that ended early
    std::int64_t iterations = 0;               ///< of all finished items
    std::optional<std::int64_t> finished_now;  ///< number of items finished by this run; no value if this process did not run the sweep
    /// The most frequent reasons why items were truncated or diverged, each with the number of items.
    std::vector<std::pair<std::string, std::int64_t>> reasons;
    std::optional<WriterLock::Writer> writer;  ///< the process that is writing the results, if there is one
    double running_for = 0;                    ///< s since that process started
    std::int64_t saved = 0;                    ///< number of items in the file, of all shards

    std::int64_t missing() const { return items - finished; }
};

/// Reads the counts of a shard from a results file, which may have items of other shards too. Sets neither the sweep file nor the writer.
Result<SweepStatus> read_sweep_status(const SweepResults&, const Shard&);

/// Returns an error if items are finished, but none of them converged.
Result<void> check_any_converged(const SweepStatus&);

}  // namespace corpuscle
