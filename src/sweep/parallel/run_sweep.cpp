#include "sweep/parallel/run_sweep.hpp"

#include "core/bytes.hpp"
#include "sweep/parallel/worker_pool.hpp"

namespace corpuscle {
namespace {

constexpr std::size_t queue_length = 1 << 14;                      // items passed to the worker pool at a time
constexpr std::size_t max_gathered_bytes = std::size_t{32} << 20;  // of the messages in one call of gather()

/// Everything that must be equal in all ranks of a sweep.
std::string identity_of(const Sweep& sweep) {
    ByteWriter out;
    out.put(sweep.item_count);
    for (const auto& entry : sweep.metadata) out.put(entry.name, entry.text);
    return out.take();
}

/// The message that starts a worker: the identity of the sweep, and the ranges of items that have no row in the results.
std::string start_message(const Sweep& sweep, const std::vector<ItemQueue::Range>& missing) {
    ByteWriter out;
    out.put(identity_of(sweep), missing);
    return out.take();
}

/// The ranges of missing items in a start message. Returns an error if its sweep is not this one.
Result<std::vector<ItemQueue::Range>> read_start(const Sweep& sweep, std::string_view message) {
    ByteReader in(message);
    std::string identity;
    std::vector<ItemQueue::Range> missing;
    if (!in.get(identity) || identity != identity_of(sweep) || !in.get(missing))
        return bad_input("reads another sweep than rank 0: give all ranks the same files");
    return missing;
}

/// Computes these items on threads. Passes the outcomes to `write` every `write_interval`, until all are finished, `run` stops them (error
/// `interrupted`), or there is an error in the sweep or in `write`.
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
    if (stopped) return interrupted_error();
    return {};
}

/// Appends the outcomes that have arrived from the workers, and subtracts the workers that have finished from `running`: the last message
/// of a worker is empty. Returns the error of a worker, if it had one.
Result<void> gather(Ranks& ranks, int& running, std::vector<ItemOutcome>& outcomes) {
    for (std::size_t bytes = 0; bytes < max_gathered_bytes;) {
        auto received = ranks.receive_any();
        if (!received) break;
        const auto message = TRY(std::move(received->message));
        bytes += message.size();
        if (message.empty()) --running;
        if (!unpack_outcomes(message, outcomes))
            return bad_input("the ranks run different versions of corpuscle; install the same one on all machines");
    }
    return {};
}

}  // namespace

std::vector<std::int64_t> ItemQueue::take(std::int64_t max) {
    std::vector<std::int64_t> out;
    out.reserve(static_cast<std::size_t>(std::clamp<std::int64_t>(max, 0, remaining_)));
    const auto has_room = [&] { return static_cast<std::int64_t>(out.size()) < max; };
    for (; has_room() && at_ < ranges_.size(); ++at_) {
        auto& [from, to] = ranges_[at_];
        for (; from < to && has_room(); ++from)
            if (shard_.contains(from) && part_.contains(passed_++)) out.push_back(from);
        if (from < to) break;
    }
    remaining_ -= static_cast<std::int64_t>(out.size());
    return out;
}

void SweepProgress::add(const ItemOutcome& o) {
    ++(o.end == ItemEnd::done ? done : o.end == ItemEnd::iteration_limit ? iteration_limit : diverged);
    steps += o.steps, iterations += o.iterations, ran_alone += o.ran_alone;
    for (const auto& train : o.spikes) spikes += static_cast<std::int64_t>(train.size());
}

Result<void> run_sweep(const Sweep& sweep, SweepResults& results, const SweepRunOptions& run, SweepProgress& progress, Ranks* ranks) {
    const auto missing = TRY(results.missing_ranges());
    progress = {.planned = ItemQueue(missing, run.shard).remaining()};
    if (!ranks && progress.planned == 0) return {};
    results.announce_run(progress.planned);
    int running = ranks ? ranks->size() - 1 : 0;  // number of workers that have not finished
    for (int rank = 1; rank <= running; ++rank) ranks->send(rank, start_message(sweep, missing));
    const auto write = [&](std::vector<ItemOutcome>&& outcomes) -> Result<void> {
        const auto gathered = ranks ? gather(*ranks, running, outcomes) : Result<void>();
        for (const auto& o : outcomes) progress.add(o);
        TRY(results.add(sweep, std::move(outcomes)));
        run.on_progress(progress);
        return gathered;
    };
    TRY(compute_items(sweep, {missing, run.shard, ranks ? Shard{0, ranks->size()} : Shard{}}, run, write));
    while (running > 0) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        TRY(write({}));
        if (run.should_stop()) return interrupted_error();
    }
    return {};
}

void run_worker(Ranks& ranks, const Result<std::unique_ptr<Sweep>>& sweep, const SweepRunOptions& run) {
    const auto ok = without_exceptions([&]() -> Result<void> {
        const auto start = TRY(ranks.receive(0));  // also if there is no sweep: rank 0 receives nothing before it has sent this
        if (!sweep) return sweep.error();
        auto missing = TRY(read_start(**sweep, start));
        const auto send = [&](std::vector<ItemOutcome>&& outcomes) {
            if (!outcomes.empty()) ranks.send(0, pack_outcomes(outcomes));
            return Result<void>();
        };
        return compute_items(**sweep, {std::move(missing), run.shard, Shard{ranks.rank(), ranks.size()}}, run, send);
    });
    ok ? ranks.send(0, "") : ranks.send_error(ok.error());
}

auto byte_fields(ItemOutcome& o) {
    return std::tie(o.item, o.end, o.reason, o.measures, o.spikes, o.probes, o.steps, o.iterations, o.ran_alone);
}

std::string pack_outcomes(const std::vector<ItemOutcome>& outcomes) {
    ByteWriter out;
    for (const auto& o : outcomes) out.put(o);
    return out.take();
}

bool unpack_outcomes(std::string_view message, std::vector<ItemOutcome>& outcomes) {
    for (ByteReader in(message); !in.ended();)
        if (auto& o = outcomes.emplace_back(); !in.get(o) || o.end > ItemEnd::diverged) return outcomes.pop_back(), false;
    return true;
}

}  // namespace corpuscle
