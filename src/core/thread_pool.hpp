#pragma once
// A thread pool that runs numbered tasks. The caller divides the work into tasks, so that the results do not depend on the number of
// threads.

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
    /// Called with the index of the task and the index of the thread that runs it, which is below threads() and 0 for the caller's thread.
    /// A task can use the thread index to select memory that no other thread uses.
    using Task = std::function<void(std::size_t, unsigned)>;

    /// `threads` is the number of threads that run tasks, including the caller of for_each(); 0: one for each core. The threads start when
    /// for_each() first has more than one task: a start costs more than a short run.
    explicit ThreadPool(unsigned threads = 0);
    ~ThreadPool();
    ThreadPool(const ThreadPool&) = delete;
    ThreadPool& operator=(const ThreadPool&) = delete;

    unsigned threads() const { return threads_; }

    /// Calls task(k, thread) once for each k below `count`, in parallel, and returns when all calls have returned. If a task throws, tasks
    /// that have not begun are skipped, and one of the exceptions is rethrown. `while_waiting`: called again and again by the caller's
    /// thread while it waits for the tasks of the others; it must not throw.
    void for_each(std::size_t count, const Task& task, const std::function<void()>& while_waiting = {});

private:
    void start_workers();
    void worker_loop(unsigned thread);
    void run_tasks(unsigned thread);

    const unsigned threads_;
    std::mutex mutex_;  // protects all members below except next_ and workers_
    // A round is a call of for_each() in which the workers take part.
    std::condition_variable round_started_, round_ended_;
    const Task* task_ = nullptr;         // of the current call of for_each()
    std::size_t count_ = 0;              // its number of tasks
    std::size_t round_ = 0;              // number of rounds started so far
    std::size_t busy_workers_ = 0;       // workers that have not yet ended the current round
    std::atomic<std::size_t> next_ = 0;  // index of the next task to begin
    bool is_stopping_ = false;           // true: workers return
    std::exception_ptr exception_;       // the latest exception of a task; null: none
    std::vector<std::thread> workers_;   // threads 1, 2, ...; thread 0 is the caller; empty before the first round
};

}  // namespace corpuscle
