#pragma once
// A thread pool that runs numbered tasks. The caller divides the work into tasks, not the pool, so results do not depend on the
// number of threads.

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace corpuscle {

class ThreadPool {
public:
    /// Called with the index of the task and the index of its thread (below threads()). The thread index can select scratch memory.
    using Task = std::function<void(std::size_t, unsigned)>;

    /// `threads` is the total, including the caller's thread; 0: one for each core.
    explicit ThreadPool(unsigned threads = 0);
    ~ThreadPool();
    ThreadPool(const ThreadPool&) = delete;
    ThreadPool& operator=(const ThreadPool&) = delete;

    unsigned threads() const { return static_cast<unsigned>(workers_.size()) + 1; }

    /// Calls task(k, thread) once for each k below `count`, on all threads, and returns when all are done. If tasks throw, those not
    /// yet started are skipped, and one of the exceptions is rethrown.
    void for_each(std::size_t count, const Task& task);

private:
    void worker_loop(unsigned thread);
    void run_tasks(unsigned thread);

    std::mutex mutex_;
    std::condition_variable round_started_, round_ended_;
    const Task* task_ = nullptr;
    std::size_t count_ = 0, round_ = 0, busy_workers_ = 0;
    std::atomic<std::size_t> next_ = 0;
    bool is_stopping_ = false;
    std::exception_ptr exception_;
    std::vector<std::thread> workers_;
};

}  // namespace corpuscle
