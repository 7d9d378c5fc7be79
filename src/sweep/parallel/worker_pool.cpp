#include "sweep/parallel/worker_pool.hpp"

#include <algorithm>
#include <chrono>
#include <exception>

namespace corpuscle {
namespace {

/// Approximate memory of an outcome.
std::size_t bytes_of(const ItemOutcome& o) {
    auto sum = sizeof(ItemOutcome) + o.reason.size() + o.measures.size() * sizeof(double);
    for (const auto& train : o.spikes) sum += sizeof(train) + train.size() * sizeof(double);
    for (const auto& samples : o.probes) sum += sizeof(samples) + samples.size() * sizeof(float);
    return sum;
}

/// Converts exceptions of libraries to errors, because an exception that leaves a thread would end the program.
Result<void> run_items_safely(const Sweep& sweep, const Sweep::NextItem& next, const Sweep::OutcomeHandler& on_outcome,
                              const std::function<bool()>& stop) {
    try {
        return sweep.run_items(next, on_outcome, stop);
    } catch (const std::exception& e) {
        return bad_input(e.what());
    }
}

}  // namespace

WorkerPool::WorkerPool(const Sweep& sweep, unsigned threads) : sweep_(sweep) {
    const unsigned all = threads > 0 ? threads : std::max(1U, std::thread::hardware_concurrency());
    for (unsigned t = 0; t < all; ++t) threads_.emplace_back([this] { work(); });
}

WorkerPool::~WorkerPool() {
    stop();
    {
        const std::lock_guard lock(mutex_);
        closing_ = true;
    }
    items_added_.notify_all();
    space_available_.notify_all();
    for (auto& t : threads_) t.join();
}

void WorkerPool::add(const std::vector<std::int64_t>& items) {
    {
        const std::lock_guard lock(mutex_);
        if (stopping_) return;
        items_.insert(items_.end(), items.begin(), items.end());
    }
    items_added_.notify_all();
}

void WorkerPool::stop() {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    items_.clear();
}

std::vector<ItemOutcome> WorkerPool::collect(double seconds) {
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

std::size_t WorkerPool::queued() const {
    const std::lock_guard lock(mutex_);
    return items_.size();
}

bool WorkerPool::is_done() const {
    const std::lock_guard lock(mutex_);
    return active_workers_ == 0 && items_.empty() && outcomes_.empty();
}

Result<void> WorkerPool::sweep_error() const {
    const std::lock_guard lock(mutex_);
    return sweep_error_;
}

// A call of Sweep::run_items may have other items in progress when it asks for the next one, so next_item() does not wait. If there is
// none, the call finishes its items and returns, and the thread waits here for more.
void WorkerPool::work() {
    std::unique_lock lock(mutex_);
    for (;;) {
        items_added_.wait(lock, [&] { return closing_ || !items_.empty(); });
        if (closing_) return;
        ++active_workers_;
        lock.unlock();
        auto ok = run_items_safely(
            sweep_, [this] { return next_item(); }, [this](ItemOutcome&& o) { deliver(std::move(o)); },
            [this] { return stopping_.load(); });
        lock.lock();
        --active_workers_;
        // Keeps the first error, and stops the pool.
        if (!ok && sweep_error_ && !stopping_) sweep_error_ = std::move(ok);
        if (!sweep_error_) stopping_ = true, items_.clear();
        outcomes_ready_.notify_all();
    }
}

std::optional<std::int64_t> WorkerPool::next_item() {
    const std::lock_guard lock(mutex_);
    if (items_.empty()) return {};
    const auto item = items_.front();
    items_.pop_front();
    return item;
}

void WorkerPool::deliver(ItemOutcome&& outcome) {
    const auto size = bytes_of(outcome);
    std::unique_lock lock(mutex_);
    space_available_.wait(lock, [&] { return pending_bytes_ < max_pending_bytes || closing_; });
    outcomes_.push_back(std::move(outcome));
    pending_bytes_ += size;
    if (pending_bytes_ >= min_collect_bytes) outcomes_ready_.notify_all();
}

}  // namespace corpuscle
