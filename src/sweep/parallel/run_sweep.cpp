#include "sweep/parallel/run_sweep.hpp"

#include <fmt/format.h>

#include "sweep/parallel/worker_pool.hpp"

namespace corpuscle {
namespace {

constexpr std::size_t queue_length = 1 << 14;  // items passed to the worker pool at a time

}  // namespace

void SweepProgress::add(const ItemOutcome& o) {
    ++(o.end == ItemEnd::done ? done : o.end == ItemEnd::iteration_limit ? iteration_limit : diverged);
    steps += o.steps, iterations += o.iterations, ran_alone += o.ran_alone;
    for (const auto& train : o.spikes) spikes += static_cast<std::int64_t>(train.size());
}

Result<void> write_outcomes(const Sweep& sweep, SweepResults& results, const SweepRunOptions& run, SweepProgress& progress,
                            std::vector<ItemOutcome>&& outcomes) {
    for (const auto& o : outcomes) progress.add(o);
    TRY(results.add(sweep, std::move(outcomes)));
    run.on_progress(progress);
    return {};
}

Result<void> compute_items(const Sweep& sweep, ItemQueue queue, const SweepRunOptions& run,
                           const std::function<Result<void>(std::vector<ItemOutcome>&&)>& write) {
    WorkerPool pool(sweep, run.threads);
    bool stopped = false;
    for (;;) {
        if (!stopped && pool.queued() < queue_length / 2) pool.add(queue.take(queue_length));
        TRY(write(pool.collect(run.write_interval)));
        if (!stopped && run.should_stop()) stopped = true, pool.stop();
        if (pool.is_done() && (stopped || queue.remaining() == 0 || !pool.sweep_error())) break;  // the last term: there was an error
    }
    TRY(pool.sweep_error());
    if (stopped) return Error{ErrorCode::interrupted, "interrupted"};
    return {};
}

Result<void> run_sweep(const Sweep& sweep, SweepResults& results, const SweepRunOptions& run, SweepProgress& progress) {
    auto missing = TRY(results.missing_ranges());
    ItemQueue queue(std::move(missing), run.shard);
    progress = {.planned = queue.remaining()};
    if (progress.planned == 0) return {};
    results.announce_run(progress.planned);
    return compute_items(sweep, std::move(queue), run, [&](std::vector<ItemOutcome>&& outcomes) {
        return write_outcomes(sweep, results, run, progress, std::move(outcomes));
    });
}

}  // namespace corpuscle
