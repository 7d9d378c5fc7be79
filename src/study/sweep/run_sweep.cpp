#include "study/sweep/run_sweep.hpp"

#include <fmt/format.h>

#include "study/sweep/crew.hpp"

namespace corpuscle {
namespace {

constexpr std::size_t queue_length = 1 << 14;  // items queued for the worker pool in advance

}  // namespace

void SweepCount::count(const UnitOutcome& o) {
    ++(o.end == UnitEnd::done ? done : o.end == UnitEnd::capped ? capped : lost);
    steps += o.steps, iterations += o.iterations, alone += o.alone;
    for (const auto& train : o.spikes) spikes += static_cast<std::int64_t>(train.size());
}

Result<void> run_sweep(const Sweep& sweep, SweepResults& results, const SweepRun& run, SweepCount& count) {
    auto missing = results.missing();
    if (!missing) return missing.error();
    UnitQueue queue(std::move(*missing), run.shard);
    count = {.to_do = queue.left()};
    if (count.to_do == 0) return {};
    results.note(count.to_do);
    Crew pool(sweep, run.threads);
    bool stopped = false;
    for (;;) {
        if (!stopped && pool.waiting() < queue_length / 2) pool.give(queue.take(queue_length));
        auto outcomes = pool.collect(run.between_writes);
        for (const auto& o : outcomes) count.count(o);
        if (auto ok = results.add(sweep, std::move(outcomes)); !ok) return ok;
        run.seen(count);
        if (!stopped && run.stop()) stopped = true, pool.stop();
        if (pool.is_done() && (stopped || queue.left() == 0 || !pool.fault())) break;
    }
    if (auto ok = pool.fault(); !ok) return ok;
    if (stopped) return Error{ErrorCode::interrupted, "interrupted"};
    return {};
}

}  // namespace corpuscle
