#include "sweep/stats/progress_status.hpp"

#include <fmt/format.h>

#include "sweep/store/sqlite.hpp"

namespace corpuscle {

Result<SweepStatus> read_sweep_status(const SweepResults& results, const Shard& shard) {
    SweepStatus out;
    out.results = results.path(), out.shard = shard, out.items = shard.count(0, results.item_count), out.saved = results.finished_count();
    const auto of_shard = fmt::format("item % {} = {}", shard.shard_count, shard.index);
    auto counts = TRY(results.file().prepare(fmt::format(
        "SELECT count(*), total(ended = 'truncated'), total(ended = 'diverged'), total(iterations) FROM items WHERE {}", of_shard)));
    TRY(counts.step());
    out.finished = counts.integer(0), out.truncated = counts.integer(1), out.diverged = counts.integer(2),
    out.iterations = counts.integer(3);
    if (out.truncated + out.diverged == 0) return out;
    auto reasons = TRY(results.file().prepare(
        fmt::format("SELECT why, count(*) FROM items WHERE ended <> 'done' AND {} GROUP BY why ORDER BY 2 DESC, 1 LIMIT 3", of_shard)));
    while (TRY(reasons.step())) out.reasons.emplace_back(reasons.text(0), reasons.integer(1));
    return out;
}

Result<void> check_any_converged(const SweepStatus& s) {
    if (s.finished == 0 || s.diverged < s.finished) return {};
    return Error{ErrorCode::not_converged, fmt::format("none of {} items converged: {}", s.diverged, s.reasons.front().first)};
}

}  // namespace corpuscle
