#include "core/thread_pool.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

namespace corpuscle {
namespace {

constexpr auto wait_interval = std::chrono::milliseconds(20);  // between calls of `while_waiting`

}  // namespace

ThreadPool::ThreadPool(unsigned threads) : threads_(threads > 0 ? threads : std::max(1U, std::thread::hardware_concurrency())) {}

void ThreadPool::start_workers() {
    for (unsigned t = 1; t < threads_; ++t) workers_.emplace_back([this, t] { worker_loop(t); });
}

ThreadPool::~ThreadPool() {
    {
        const std::lock_guard lock(mutex_);
        is_stopping_ = true;
    }
    round_started_.notify_all();
    for (auto& h : workers_) h.join();
}

void ThreadPool::for_each(std::size_t count, const Task& task, const std::function<void()>& while_waiting) {
    if (workers_.empty() && threads_ > 1 && count > 1) start_workers();
    if (workers_.empty()) {  // without a lock, to keep the overhead small
        for (std::size_t k = 0; k < count; ++k) task(k, 0);
        return;
    }
    const bool is_single = count < 2;  // then the caller runs the task, and no worker is woken
    {
        const std::lock_guard lock(mutex_);
        task_ = &task, count_ = count, next_ = 0;
        if (!is_single) ++round_, busy_workers_ = workers_.size();
    }
    if (!is_single) round_started_.notify_all();
    run_tasks(0);
    std::unique_lock lock(mutex_);
    const auto has_ended = [this] { return busy_workers_ == 0; };
    while (while_waiting && !round_ended_.wait_for(lock, wait_interval, has_ended)) {
        lock.unlock();
        while_waiting();
        lock.lock();
    }
    round_ended_.wait(lock, has_ended);
    if (exception_) std::rethrow_exception(std::exchange(exception_, nullptr));
}

void ThreadPool::worker_loop(unsigned thread) {
    for (std::size_t seen = 0;;) {  // seen: the last round in which this worker took part
        {
            std::unique_lock lock(mutex_);
            round_started_.wait(lock, [&] { return is_stopping_ || round_ != seen; });
            if (is_stopping_) return;
            seen = round_;
        }
        run_tasks(thread);
        const std::lock_guard lock(mutex_);
        if (--busy_workers_ == 0) round_ended_.notify_one();
    }
}

void ThreadPool::run_tasks(unsigned thread) {
    for (std::size_t k = next_++; k < count_; k = next_++) try {
            (*task_)(k, thread);
        } catch (...) {
            const std::lock_guard lock(mutex_);
            exception_ = std::current_exception();
            next_ = count_;  // skips the tasks that have not begun
        }
}

}  // namespace corpuscle
