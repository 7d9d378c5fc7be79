#pragma once
// Threads that compute work items and return the outcomes.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

#include "sweep/spec/sweep.hpp"

namespace corpuscle {

/// One thread, the owner of the pool, adds items and collects outcomes. Each worker thread calls Sweep::run_items while there are items.
class WorkerPool {
    /// Sizes of the uncollected outcomes, bytes: at max_pending_bytes, worker threads wait; at min_collect_bytes, collect() returns.
    static constexpr std::size_t max_pending_bytes = std::size_t{32} << 20, min_collect_bytes = max_pending_bytes / 4;

    const Sweep& sweep_;
    mutable std::mutex mutex_;
    std::condition_variable items_added_, outcomes_ready_, space_available_;
    std::deque<std::int64_t> items_;      // that have not started
    std::vector<ItemOutcome> outcomes_;   // that are not collected
    std::size_t pending_bytes_ = 0;       // size of outcomes_, bytes
    unsigned active_workers_ = 0;         // threads in Sweep::run_items
    std::atomic<bool> stopping_ = false;  // the sweep shall stop; no more items are added
    bool closing_ = false;                // the threads shall end
    Result<void> sweep_error_;            // success, which converts to true: none
    std::vector<std::thread> threads_;

    /// Approximate memory of an outcome.
    static std::size_t bytes_of(const ItemOutcome& o) {
        auto sum = sizeof(ItemOutcome) + o.reason.size() + o.measures.size() * sizeof(double);
        for (const auto& train : o.spikes) sum += sizeof(train) + train.size() * sizeof(double);
        for (const auto& samples : o.probes) sum += sizeof(samples) + samples.size() * sizeof(float);
        return sum;
    }

    /// Converts exceptions of libraries to errors, because an exception that leaves a thread would end the program.
    Result<void> run_items() {
        try {
            return sweep_.run_items([this] { return next_item(); }, [this](ItemOutcome&& o) { deliver(std::move(o)); },
                                    [this] { return stopping_.load(); });
        } catch (const std::exception& e) {
            return bad_input(e.what());
        }
    }

    /// A call of Sweep::run_items may have other items in progress when it asks for the next one, so next_item() does not wait. If there is
    /// none, the call finishes its items and returns, and the thread waits here for more.
    void work() {
        std::unique_lock lock(mutex_);
        for (;;) {
            items_added_.wait(lock, [&] { return closing_ || !items_.empty(); });
            if (closing_) return;
            ++active_workers_;
            lock.unlock();
            auto ok = run_items();
            lock.lock();
            --active_workers_;
            // Keeps the first error, and stops the pool.
            if (!ok && sweep_error_ && !stopping_) sweep_error_ = std::move(ok);
            if (!sweep_error_) stopping_ = true, items_.clear();
            outcomes_ready_.notify_all();
        }
    }

    std::optional<std::int64_t> next_item() {
        const std::lock_guard lock(mutex_);
        if (items_.empty()) return {};
        const auto item = items_.front();
        items_.pop_front();
        return item;
    }

    void deliver(ItemOutcome&& outcome) {
        const auto size = bytes_of(outcome);
        std::unique_lock lock(mutex_);
        space_available_.wait(lock, [&] { return pending_bytes_ < max_pending_bytes || closing_; });
        outcomes_.push_back(std::move(outcome));
        pending_bytes_ += size;
        if (pending_bytes_ >= min_collect_bytes) outcomes_ready_.notify_all();
    }

public:
    /// `threads`: 0: one for each core.
    WorkerPool(const Sweep& sweep, unsigned threads) : sweep_(sweep) {
        const unsigned all = threads > 0 ? threads : std::max(1U, std::thread::hardware_concurrency());
        for (unsigned t = 0; t < all; ++t) threads_.emplace_back([this] { work(); });
    }
    WorkerPool(const WorkerPool&) = delete;
    WorkerPool& operator=(const WorkerPool&) = delete;
    /// Discards unfinished items.
    ~WorkerPool() {
        stop();
        {
            const std::lock_guard lock(mutex_);
            closing_ = true;
        }
        items_added_.notify_all();
        space_available_.notify_all();
        for (auto& t : threads_) t.join();
    }

    void add(const std::vector<std::int64_t>& items) {
        {
            const std::lock_guard lock(mutex_);
            if (stopping_) return;
            items_.insert(items_.end(), items.begin(), items.end());
        }
        items_added_.notify_all();
    }
    /// Removes the items that have not started, and asks the sweep to stop: items in progress may end without an outcome.
    void stop() {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
        items_.clear();
    }

    /// Returns the outcomes since the last call. Waits up to this time (s), but not longer than until they have min_collect_bytes or all
    /// items are finished.
    std::vector<ItemOutcome> collect(double seconds) {
        std::unique_lock lock(mutex_);
        outcomes_ready_.wait_for(lock, std::chrono::duration<double>(seconds),
                                 [&] { return pending_bytes_ >= min_collect_bytes || (active_workers_ == 0 && items_.empty()); });
        std::vector<ItemOutcome> out;
        out.swap(outcomes_);
        pending_bytes_ = 0;
        lock.unlock();
        space_available_.notify_all();
        return out;
    }
    /// Number of items that have not started.
    std::size_t queued() const {
        const std::lock_guard lock(mutex_);
        return items_.size();
    }
    /// True if all items are finished (or discarded) and their outcomes collected.
    bool is_done() const {
        const std::lock_guard lock(mutex_);
        return active_workers_ == 0 && items_.empty() && outcomes_.empty();
    }
    /// The first error of Sweep::run_items; success if there was none. After an error, the pool is stopped.
    Result<void> sweep_error() const {
        const std::lock_guard lock(mutex_);
        return sweep_error_;
    }
};

}  // namespace corpuscle
