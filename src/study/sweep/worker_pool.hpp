#pragma once
// Threads that compute work items and return the outcomes.

#include <atomic>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

#include "study/sweep/sweep.hpp"

namespace corpuscle {

/// One thread adds items and collects outcomes. `threads` worker threads each run Sweep::run_items while there are items.
class WorkerPool {
public:
    WorkerPool(const Sweep&, unsigned threads);
    ~WorkerPool();  ///< discards unfinished items
    WorkerPool(const WorkerPool&) = delete;
    WorkerPool& operator=(const WorkerPool&) = delete;

    void add(const std::vector<std::int64_t>& items);
    /// Removes items that have not started. Items in progress end as soon as the sweep can be stopped.
    void stop();

    /// Outcomes since the last call. Waits up to this time (s), but returns at once if there are many or if no thread is working.
    std::vector<ItemOutcome> collect(double seconds);
    std::size_t queued() const;  ///< items that have not started
    bool is_done() const;        ///< all items are finished and collected
    /// The error in the sweep itself, if there was one.
    Result<void> sweep_error() const;

    /// Threads wait if the uncollected outcomes exceed this size, bytes.
    static constexpr std::size_t max_pending_bytes = std::size_t{32} << 20, min_collect_bytes = max_pending_bytes / 4;

private:
    void work();
    std::optional<std::int64_t> next();
    void deliver(ItemOutcome&&);

    const Sweep& sweep_;
    mutable std::mutex mutex_;
    std::condition_variable items_added_, outcomes_ready_, space_available_;
    std::deque<std::int64_t> items_;
    std::vector<ItemOutcome> outcomes_;
    std::size_t pending_bytes_ = 0;  // size of outcomes_, bytes
    unsigned active_workers_ = 0;
    std::atomic<bool> stopping_ = false;
    bool closing_ = false;
    Result<void> sweep_error_;
    std::vector<std::thread> threads_;
};

}  // namespace corpuscle
