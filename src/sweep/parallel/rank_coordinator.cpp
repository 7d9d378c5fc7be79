// The coordinator (rank 0): owns the results file, distributes items to the workers (the other ranks), and takes back the items of dead
// workers.

#include <fmt/format.h>
#include <algorithm>
#include <thread>
#include <unordered_set>

#include "sweep/parallel/rank_messages.hpp"
#include "sweep/parallel/rank_run.hpp"
#include "sweep/parallel/rank_time.hpp"
#include "sweep/parallel/worker_pool.hpp"

namespace corpuscle {
namespace {

/// A worker rank, as the coordinator sees it.
struct WorkerState {
    RankHandshake handshake;
    bool is_local = false;                   // its process is on this machine
    bool is_alive = true;                    // false: counted as dead, until it sends a message again
    bool is_counted = false;                 // it has been counted in DeadRanks::ranks
    std::unordered_set<std::int64_t> items;  // sent to it, without an outcome yet
    std::int64_t requested = 0;              // number of further items that it has requested
    RankTime last_received, last_sent;       // times of the last message from it and to it

    /// True if its process is known to be dead.
    bool process_died() const { return is_local && handshake.is_dead(); }
};

class Coordinator {
    static constexpr double drain_time = 0.5;             // s; after a stop, time for outcomes that workers have ready
    static constexpr std::size_t write_threshold = 4096;  // with this number of pending outcomes, they are written at once

    Ranks& ranks_;
    const Sweep& sweep_;
    SweepResults& results_;
    const SweepRunOptions& run_;
    SweepProgress& progress_;
    DeadRanks& dead_ranks_;
    ItemQueue queue_;
    std::vector<WorkerState> workers_;  // by rank; 0 is not used
    std::vector<ItemOutcome> pending_;  // outcomes to write
    const std::uint64_t metadata_hash_;
    const unsigned threads_;                                           // of this rank
    RankThroughput throughput_;                                        // of this rank
    RankTime now_ = rank_time(), written_ = now_, stopped_at_ = now_;  // of the present round, the last write, the stop
    bool stopped_ = false;                                             // by SweepRunOptions::should_stop
    Result<void> fault_;  // the first error in the sweep, of any rank; success, which converts to true: none
    WorkerPool pool_;     // the threads of this rank

    void send(std::size_t rank, const Message& m) {
        ranks_.send(static_cast<int>(rank), m.bytes());
        workers_[rank].last_sent = now_;
    }

    /// Takes an outcome of any rank.
    void accept(ItemOutcome&& o) {
        progress_.add(o);
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

    /// Handles a message of a worker.
    void handle(std::size_t rank, Message m) {
        auto& worker = workers_[rank];
        worker.last_received = now_;
        if (!worker.is_alive) worker.is_alive = !worker.process_died();  // it may have sent the message before it died
        const auto type = decode_rank_message_type(m);
        std::uint64_t number = 0;
        std::vector<ItemOutcome> outcomes;
        Error error;
        if (type == RankMessageType::handshake) handle_handshake(rank, m);
        if (type == RankMessageType::request && m.get(number)) worker.requested = static_cast<std::int64_t>(number);
        // Outcomes of items that the worker does not have are ignored: it was counted as dead, and its items were put back.
        if (type == RankMessageType::outcomes && decode_rank_message(m, outcomes))
            for (auto& o : outcomes)
                if (worker.items.erase(o.item) > 0) accept(std::move(o));
        if (type == RankMessageType::sweep_error && decode_rank_message(m, error) && fault_)
            fault_ = Error{error.code, fmt::format("rank {} on {}: {}", rank, worker.handshake.host, error.message)};
    }

    /// Counts a worker as dead and puts its items back.
    void mark_dead(std::size_t rank) {
        auto& worker = workers_[rank];
        queue_.put_back({worker.items.begin(), worker.items.end()});
        if (!std::exchange(worker.is_counted, true)) ++dead_ranks_.ranks;
        dead_ranks_.redistributed_items += static_cast<std::int64_t>(worker.items.size());
        worker.is_alive = false, worker.requested = 0;
        worker.items.clear();
        ranks_.drop_messages_of(static_cast<int>(rank));
    }

    /// Checks whether a worker is still alive, and sends it a heartbeat if necessary.
    void check_worker(std::size_t rank) {
        auto& worker = workers_[rank];
        if (!worker.is_alive) return;
        if (worker.process_died() || seconds_between(worker.last_received, now_) > rank_timeout) return mark_dead(rank);
        if (seconds_between(worker.last_sent, now_) > heartbeat_interval) send(rank, rank_message(RankMessageType::heartbeat));
    }

    /// Gives items to the workers that request them, and to the threads of this rank.
    void distribute() {
        if (stopped_ || queue_.remaining() == 0) return;
        const auto alive = 1 + std::count_if(workers_.begin() + 1, workers_.end(), [](const WorkerState& w) { return w.is_alive; });
        // The fewer items are left, the fewer a rank gets at a time, so that all ranks finish at about the same time.
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

    /// Writes the pending outcomes, if there are many or the last write was long ago.
    Result<void> write() {
        if (pending_.size() < write_threshold && seconds_between(written_, now_) < run_.write_interval) return {};
        auto ok = results_.add(sweep_, std::exchange(pending_, {}));
        written_ = now_ = rank_time();
        run_.on_progress(progress_);
        return ok;
    }

    bool is_over() const {
        if (stopped_) return pool_.is_done() && seconds_between(stopped_at_, now_) > drain_time;
        return queue_.remaining() == 0 && pool_.is_done() && pending_.empty() &&
               std::all_of(workers_.begin() + 1, workers_.end(), [](const WorkerState& w) { return w.items.empty(); });
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
            TRY(write());
            if (auto ok = pool_.sweep_error(); !ok && fault_) fault_ = ok;
            if (!fault_) break;
            if (!stopped_ && run_.should_stop()) stopped_ = true, stopped_at_ = now_, pool_.stop();
        }
        TRY(results_.add(sweep_, std::exchange(pending_, {})));
        if (!fault_) return fault_;
        if (stopped_) return Error{ErrorCode::interrupted, "interrupted"};
        return {};
    }

public:
    Coordinator(Ranks& ranks, const Sweep& sweep, SweepResults& results, const SweepRunOptions& run, SweepProgress& progress,
                DeadRanks& dead_ranks, std::vector<ItemQueue::Range> missing)
        : ranks_(ranks), sweep_(sweep), results_(results), run_(run), progress_(progress), dead_ranks_(dead_ranks),
          queue_(std::move(missing), run.shard), workers_(static_cast<std::size_t>(ranks.size())),
          metadata_hash_(RankHandshake::of_this_process(&sweep).metadata_hash), threads_(std::max(1U, run.threads)),
          pool_(sweep, threads_) {
        progress_ = {.planned = queue_.remaining()};
        results_.announce_run(progress_.planned);
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
        return std::all_of(workers_.begin() + 1, workers_.end(), [](const WorkerState& w) { return w.is_alive; });
    }
};

/// Sends a shutdown message to all workers, waits at most heartbeat_interval until the messages are sent, and leaves.
void end_all(Ranks& ranks, bool together) {
    for (int rank = 1; rank < ranks.size(); ++rank) ranks.send(rank, rank_message(RankMessageType::shutdown, together).bytes());
    const auto start = rank_time();
    while (ranks.unsent() > 0 && seconds_between(start, rank_time()) < heartbeat_interval) std::this_thread::sleep_for(rank_tick);
    ranks.leave(together);
}

}  // namespace

Result<void> run_coordinator(Ranks& ranks, const Sweep& sweep, SweepResults& results, const SweepRunOptions& run, SweepProgress& progress,
                             DeadRanks& dead_ranks) {
    auto missing = results.missing_ranges();
    if (!missing) {
        shut_down_workers(ranks);
        return missing.error();
    }
    Coordinator coordinator(ranks, sweep, results, run, progress, dead_ranks, std::move(*missing));
    auto ok = coordinator.run();
    end_all(ranks, coordinator.all_alive());
    return ok;
}

void shut_down_workers(Ranks& ranks) { end_all(ranks, true); }

}  // namespace corpuscle
