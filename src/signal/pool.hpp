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

class Pool {
public:
    /// Called with the task's index and the index of its thread, below threads(), which can select scratch memory.
    using Piece = std::function<void(std::size_t, unsigned)>;

    /// `threads` is the total, including the caller's thread; 0: one for each core.
    explicit Pool(unsigned threads = 0);
    ~Pool();
    Pool(const Pool&) = delete;
    Pool& operator=(const Pool&) = delete;

    unsigned threads() const { return static_cast<unsigned>(helpers_.size()) + 1; }

    /// Calls task(k, thread) once for each k below `count`, on all threads, and returns when all are done. If tasks throw, those not
    /// yet started are skipped, and one of the exceptions is rethrown.
    void each(std::size_t count, const Piece& task);

private:
    void help(unsigned thread);
    void work(unsigned thread);

    std::mutex guard_;
    std::condition_variable begun_, ended_;
    const Piece* piece_ = nullptr;
    std::size_t count_ = 0, round_ = 0, helping_ = 0;
    std::atomic<std::size_t> next_ = 0;
    bool closing_ = false;
    std::exception_ptr failed_;
    std::vector<std::thread> helpers_;
};

}  // namespace corpuscle
