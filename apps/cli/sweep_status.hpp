#pragma once
// The progress of a sweep, as text and JSON.

#include <nlohmann/json_fwd.hpp>

#include "study/sweep/item_queue.hpp"
#include "study/sweep/sweep_results.hpp"
#include "study/sweep/writer_lock.hpp"

namespace corpuscle {

struct SweepStatus {
    std::string sweep, results;  ///< paths; sweep: "" if unknown
    Shard shard;
    std::int64_t items = 0;  ///< work items of the shard; all counts below are of the shard, too
    std::int64_t finished = 0, truncated = 0, diverged = 0, iterations = 0;
    std::optional<std::int64_t> finished_now;                   ///< finished during this run
    std::vector<std::pair<std::string, std::int64_t>> reasons;  ///< the most frequent reasons why items were truncated or diverged
    std::optional<WriterLock::Writer> writer;                   ///< the process that is writing the results
    double running_for = 0;                                     ///< s since that process started

    std::int64_t missing() const { return items - finished; }
};

Result<SweepStatus> read_sweep_status(const SweepResults&, const Shard&);
std::string sweep_status_text(const SweepStatus&);
nlohmann::ordered_json document_of(const SweepStatus&);

}  // namespace corpuscle
