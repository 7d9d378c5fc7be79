#pragma once
// How far a sweep is, in words.

#include <nlohmann/json_fwd.hpp>

#include "study/sweep/results.hpp"
#include "study/sweep/unit_queue.hpp"
#include "study/sweep/writer_lock.hpp"

namespace corpuscle {

struct SweepState {
    std::string sweep, results;  ///< files; sweep: "" if it is not known
    Shard shard;
    std::int64_t units = 0;  ///< of the shard, as all below
    std::int64_t finished = 0, capped = 0, lost = 0, iterations = 0;
    std::optional<std::int64_t> now;                            ///< finished by this run
    std::vector<std::pair<std::string, std::int64_t>> reasons;  ///< why units were capped or lost: the most frequent
    std::optional<WriterLock::Writer> writer;                   ///< who is at it
    double written_for = 0;                                     ///< s

    std::int64_t missing() const { return units - finished; }
};

Result<SweepState> state_of(const SweepResults&, const Shard&);
std::string text_of(const SweepState&);
nlohmann::ordered_json document_of(const SweepState&);

}  // namespace corpuscle
