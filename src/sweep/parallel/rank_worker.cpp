// A worker, which is any rank except rank 0: requests items from rank 0, computes them, and sends the outcomes.

#include <fmt/format.h>
#include <algorithm>
#include <chrono>
#include <thread>

#include "sweep/parallel/rank_messages.hpp"
#include "sweep/parallel/rank_run.hpp"
#include "sweep/parallel/rank_time.hpp"
#include "sweep/parallel/worker_pool.hpp"

namespace corpuscle {
namespace {

class RankWorker {
    static constexpr double delivery_interval = 0.1;  // s between two messages with outcomes
    static constexpr std::size_t max_unsent = 8;      // messages; while this number is unsent, outcomes stay in the pool

    Ranks& ranks_;
    const SweepRunOptions& run_;
    const unsigned threads_;
    std::optional<WorkerPool> pool_;  // no value: this rank could not read the sweep
    RankHandshake coordinator_;
    RankTime now_, last_received_ = rank_time(), last_sent_ = last_received_, last_delivered_ = last_received_;
    RankThroughput throughput_;
    bool has_request_ = false;           // a request has not been answered yet
    bool error_reported_ = false;        // an error in the sweep has been sent to rank 0
    bool is_over_ = false;               // rank 0 has ended the run
    bool leave_together_ = true;         // with all other ranks, see Ranks::leave()
    bool is_stopped_ = false;            // by SweepRunOptions::should_stop
    bool coordinator_is_local_ = false;  // the process of rank 0 is on this machine

    void send(const Message& m) {
        ranks_.send(0, m.bytes());
        last_sent_ = now_;
    }

    void handle(Message m) {
        last_received_ = now_;
        const auto type = decode_rank_message_type(m);
        std::uint64_t together = 0;
        std::vector<std::int64_t> items;
        if (type == RankMessageType::handshake && decode_rank_message(m, coordinator_))
            coordinator_is_local_ = coordinator_.is_on_this_machine();
        if (type == RankMessageType::shutdown && m.get(together)) is_over_ = true, leave_together_ = together != 0;
        if (type == RankMessageType::items && decode_rank_message(m, items) && pool_) pool_->add(items), has_request_ = false;
    }

    void deliver_outcomes() {
        if (seconds_between(last_delivered_, now_) < delivery_interval || ranks_.unsent() >= max_unsent) return;
        const auto outcomes = pool_->collect(0);
        throughput_.add_finished(outcomes.size(), now_);
        last_delivered_ = now_;
        if (!outcomes.empty()) send(rank_message(outcomes));
    }

    void request_items() {
        const auto wanted = throughput_.queue_target(threads_);
        const auto waiting = static_cast<std::int64_t>(pool_->queued());
        if (has_request_ || is_stopped_ || 2 * waiting > wanted) return;
        has_request_ = true;
        send(rank_message(RankMessageType::request, static_cast<std::uint64_t>(wanted - waiting)));
    }

    void work() {
        deliver_outcomes();
        if (const auto ok = pool_->sweep_error(); !ok && !error_reported_) send(rank_message(ok.error())), error_reported_ = true;
        request_items();
        if (!is_stopped_ && run_.should_stop()) is_stopped_ = true, pool_->stop();
    }

    bool coordinator_is_gone() const {
        return (coordinator_is_local_ && coordinator_.is_dead()) || seconds_between(last_received_, now_) > rank_timeout;
    }

public:
    RankWorker(Ranks& ranks, const Result<std::unique_ptr<Sweep>>& sweep, const SweepRunOptions& run)
        : ranks_(ranks), run_(run), threads_(std::max(1U, run.threads)) {
        now_ = rank_time();
        send(rank_message(RankHandshake::of_this_process(sweep ? sweep->get() : nullptr)));
        if (sweep)
            pool_.emplace(**sweep, threads_);
        else
            send(rank_message(sweep.error()));
    }

    Result<void> run() {
        for (; !is_over_; std::this_thread::sleep_for(rank_tick)) {
            now_ = rank_time();
            while (auto received = ranks_.receive()) handle(Message(std::move(received->message)));
            if (pool_) work();
            if (seconds_between(last_sent_, now_) > heartbeat_interval) send(rank_message(RankMessageType::heartbeat));
            if (coordinator_is_gone()) {
                ranks_.leave(false);
                return bad_input(
                    fmt::format("rank {}: rank 0, which writes the results, has died; results so far are kept, and the same "
                                "command resumes",
                                ranks_.rank()));
            }
        }
        pool_.reset();
        ranks_.leave(leave_together_);
        return {};
    }
};

}  // namespace

Result<void> run_worker(Ranks& ranks, const Result<std::unique_ptr<Sweep>>& sweep, const SweepRunOptions& run) {
    return RankWorker(ranks, sweep, run).run();
}

}  // namespace corpuscle
