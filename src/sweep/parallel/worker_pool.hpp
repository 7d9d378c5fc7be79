#pragma once
// Threads that compute work items and return the outcomes.

#include <atomic>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

#include "sweep/spec/sweep.hpp"

namespace corpuscle {

/// One thread, the owner of the pool, adds items and collects outcomes. Each worker thread calls Sweep::run_items while there are items.
class WorkerPool {
public:
    WorkerPool(const Sweep&, unsigned threads);  ///< threads: 0: one for each core
    ~WorkerPool();                               ///< discards unfinished items
    WorkerPool(const WorkerPool&) = delete;
    WorkerPool& operator=(const WorkerPool&) = delete;

    void add(const std::vector<std::int64_t>& items);
    /// Removes the items that have not started, and asks the sweep to stop: items in progress may end without an outcome.
    void stop();

    /// Returns the outcomes since the last call. Waits up to this time (s), but not longer than until they have min_collect_bytes or all
    /// items are finished.
    std::vector<ItemOutcome> collect(double seconds);
    std::size_t queued() const;  ///< number of items that have not started
    bool is_done() const;        ///< true if all items are finished (or discarded) and their outcomes collected
    /// The first error of Sweep::run_items; success if there was none. After an error, the pool is stopped.
    Result<void> sweep_error() const;

    /// Sizes of the uncollected outcomes, bytes: at max_pending_bytes, worker threads wait; at min_collect_bytes, collect() returns.
    static constexpr std::size_t max_pending_bytes = std::size_t{32} << 20, min_collect_bytes = max_pending_bytes / 4;

private:
    void work();
    std::optional<std::int64_t> next_item();
    void deliver(ItemOutcome&&);

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
};

}  // namespace corpuscle
