// Rank 0: owns the file, distributes blocks of items, and takes back the items of dead ranks.

#include <fmt/format.h>
#include <algorithm>
#include <thread>
#include <unordered_set>

#include "study/sweep/rank_messages.hpp"
#include "study/sweep/rank_run.hpp"
#include "study/sweep/rank_time.hpp"
#include "study/sweep/worker_pool.hpp"

namespace corpuscle {
namespace {

struct WorkerState {
    RankHandshake handshake;
    bool is_local = false, is_alive = true, is_counted = false;  // is_local: on this machine; is_counted: among the dead ranks
    std::unordered_set<std::int64_t> items;                      // items in progress
    std::int64_t requested = 0;
    RankTime last_received, last_sent;

    bool is_gone() const { return is_local && handshake.is_dead(); }
};

class Coordinator {
    static constexpr double drain_time = 0.5;             // s; after a stop, time for outcomes that workers have ready
    static constexpr std::size_t write_threshold = 4096;  // outcomes

    Ranks& ranks_;
    const Sweep& sweep_;
    SweepResults& results_;
    const SweepRunOptions& run_;
    SweepProgress& count_;
    DeadRanks& dead_ranks_;
    ItemQueue queue_;
    std::vector<WorkerState> workers_;  // by rank; 0 is not used
    std::vector<ItemOutcome> pending_;
    const std::uint64_t metadata_hash_;
    const unsigned threads_;
    RankThroughput throughput_;
    RankTime now_ = rank_time(), written_ = now_, stopped_at_ = now_;
    bool stopped_ = false;
    Result<void> fault_;
    WorkerPool pool_;

    void send(std::size_t rank, const Message& m) {
        ranks_.send(static_cast<int>(rank), m.bytes());
        workers_[rank].last_sent = now_;
    }

    void accept(ItemOutcome&& o) {
        count_.add(o);
        pending_.push_back(std::move(o));
    }

    void handle_handshake(std::size_t rank, Message& m) {
        auto& worker = workers_[rank];
        if (!decode_rank_message(m, worker.handshake)) return;
        worker.is_local = worker.handshake.is_on_this_machine();
        if (worker.handshake.metadata_hash != 0 && worker.handshake.metadata_hash != metadata_hash_ && fault_)
            fault_ = bad_input(
                fmt::format("rank {} on {} reads another sweep than rank 0: give all ranks the same files", rank, worker.handshake.host));
    }

    void handle(std::size_t rank, Message m) {
        auto& worker = workers_[rank];
        worker.last_received = now_;
        if (!worker.is_alive) worker.is_alive = !worker.is_gone();  // the message may have been sent before it died
        const auto type = decode_rank_message_type(m);
        std::uint64_t number = 0;
        std::vector<ItemOutcome> outcomes;
        Error error;
        if (type == RankMessageType::handshake) handle_handshake(rank, m);
        if (type == RankMessageType::request && m.get(number)) worker.requested = static_cast<std::int64_t>(number);
        // Outcomes of other items are ignored: these were given to other ranks when this rank was counted as dead.
        if (type == RankMessageType::outcomes && decode_rank_message(m, outcomes))
            for (auto& o : outcomes)
                if (worker.items.erase(o.item) > 0) accept(std::move(o));
        if (type == RankMessageType::sweep_error && decode_rank_message(m, error) && fault_)
            fault_ = Error{error.code, fmt::format("rank {} on {}: {}", rank, worker.handshake.host, error.message)};
    }

    void mark_dead(std::size_t rank) {
        auto& worker = workers_[rank];
        queue_.put_back({worker.items.begin(), worker.items.end()});
        if (!std::exchange(worker.is_counted, true)) ++dead_ranks_.ranks;
        dead_ranks_.redistributed_items += static_cast<std::int64_t>(worker.items.size());
        worker.is_alive = false, worker.requested = 0;
        worker.items.clear();
        ranks_.drop_messages_to(static_cast<int>(rank));
    }

    void check_worker(std::size_t rank) {
        auto& worker = workers_[rank];
        if (!worker.is_alive) return;
        if (worker.is_gone() || seconds_between(worker.last_received, now_) > rank_timeout) return mark_dead(rank);
        if (seconds_between(worker.last_sent, now_) > heartbeat_interval) send(rank, rank_message(RankMessageType::heartbeat));
    }

    void distribute() {
        if (stopped_ || queue_.remaining() == 0) return;
        const auto alive = 1 + std::count_if(workers_.begin() + 1, workers_.end(), [](const WorkerState& f) { return f.is_alive; });
        // Shrinking blocks make all ranks finish at about the same time.
        const auto block_size = [&] { return std::max<std::int64_t>(1, queue_.remaining() / (2 * alive)); };
        for (std::size_t rank = 1; rank < workers_.size() && queue_.remaining() > 0; ++rank) {
            auto& worker = workers_[rank];
            if (!worker.is_alive || worker.requested == 0) continue;
            const auto items = queue_.take(std::min(worker.requested, block_size()));
            worker.items.insert(items.begin(), items.end());
            worker.requested = 0;
            send(rank, rank_message(items));
        }
        const auto wanted = throughput_.queue_target(threads_), waiting = static_cast<std::int64_t>(pool_.queued());
        if (2 * waiting <= wanted && queue_.remaining() > 0) pool_.add(queue_.take(std::min(wanted - waiting, block_size())));
    }

    Result<void> write() {
        if (pending_.size() < write_threshold && seconds_between(written_, now_) < run_.write_interval) return {};
        auto ok = results_.add(sweep_, std::exchange(pending_, {}));
        written_ = now_ = rank_time();
        run_.on_progress(count_);
        return ok;
    }

    bool is_over() const {
        if (stopped_) return pool_.is_done() && seconds_between(stopped_at_, now_) > drain_time;
        return queue_.remaining() == 0 && pool_.is_done() && pending_.empty() &&
               std::all_of(workers_.begin() + 1, workers_.end(), [](const WorkerState& f) { return f.items.empty(); });
    }

    Result<void> run_loop() {
        for (; !is_over(); std::this_thread::sleep_for(rank_tick)) {
            now_ = rank_time();
            while (auto received = ranks_.receive())
                handle(static_cast<std::size_t>(received->from), Message(std::move(received->message)));
            for (std::size_t rank = 1; rank < workers_.size(); ++rank) check_worker(rank);
            distribute();
            auto outcomes = pool_.collect(0);
            throughput_.add_finished(outcomes.size(), now_);
            for (auto& o : outcomes) accept(std::move(o));
            if (auto ok = write(); !ok) return ok;
            if (auto ok = pool_.sweep_error(); !ok && fault_) fault_ = ok;
            if (!fault_) break;
            if (!stopped_ && run_.should_stop()) stopped_ = true, stopped_at_ = now_, pool_.stop();
        }
        if (auto ok = results_.add(sweep_, std::exchange(pending_, {})); !ok) return ok;
        if (!fault_) return fault_;
        if (stopped_) return Error{ErrorCode::interrupted, "interrupted"};
        return {};
    }

public:
    Coordinator(Ranks& ranks, const Sweep& sweep, SweepResults& results, const SweepRunOptions& run, SweepProgress& count,
                DeadRanks& dead_ranks, std::vector<ItemQueue::Range> missing)
        : ranks_(ranks), sweep_(sweep), results_(results), run_(run), count_(count), dead_ranks_(dead_ranks),
          queue_(std::move(missing), run.shard), workers_(static_cast<std::size_t>(ranks.size())),
          metadata_hash_(RankHandshake::of_this_process(&sweep).metadata_hash), threads_(std::max(1U, run.threads)),
          pool_(sweep, threads_) {
        count_ = {.planned = queue_.remaining()};
        results_.announce_run(count_.planned);
        for (std::size_t rank = 1; rank < workers_.size(); ++rank) {
            workers_[rank].last_received = now_;
            send(rank, rank_message(RankHandshake::of_this_process(&sweep)));
        }
    }

    Result<void> run() {
        auto ok = run_loop();
        pool_.stop();
        return ok;
    }

    bool all_alive() const {
        return std::all_of(workers_.begin() + 1, workers_.end(), [](const WorkerState& f) { return f.is_alive; });
    }
};

/// Sends a shutdown message to all ranks. Does not wait for dead ranks.
void end_all(Ranks& ranks, bool together) {
    for (int rank = 1; rank < ranks.size(); ++rank) ranks.send(rank, rank_message(RankMessageType::shutdown, together).bytes());
    const auto begun = rank_time();
    while (ranks.unsent() > 0 && seconds_between(begun, rank_time()) < heartbeat_interval) std::this_thread::sleep_for(rank_tick);
    ranks.leave(together);
}

}  // namespace

Result<void> run_coordinator(Ranks& ranks, const Sweep& sweep, SweepResults& results, const SweepRunOptions& run, SweepProgress& count,
                             DeadRanks& dead_ranks) {
    auto missing = results.missing_ranges();
    if (!missing) {
        shut_down_workers(ranks);
        return missing.error();
    }
    Coordinator coordinator(ranks, sweep, results, run, count, dead_ranks, std::move(*missing));
    auto ok = coordinator.run();
    end_all(ranks, coordinator.all_alive());
    return ok;
}

void shut_down_workers(Ranks& ranks) { end_all(ranks, true); }

}  // namespace corpuscle
