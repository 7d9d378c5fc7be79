#pragma once
// Threads that share out numbered pieces of work. The pieces are cut by whoever hands them in, not by the number of threads, so
// that no result depends on it.

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
    /// A piece's number, and that of the thread it runs on, below threads(): for scratch memory.
    using Piece = std::function<void(std::size_t, unsigned)>;

    /// `threads` in all, the caller's own among them; 0: as many as the machine has cores.
    explicit Pool(unsigned threads = 0);
    ~Pool();
    Pool(const Pool&) = delete;
    Pool& operator=(const Pool&) = delete;

    unsigned threads() const { return static_cast<unsigned>(helpers_.size()) + 1; }

    /// Calls piece(k, thread) once for each k below `count`, on several threads at once; returns when all are done. If pieces
    /// throw, those not yet begun are left out, and one of the exceptions is thrown on.
    void each(std::size_t count, const Piece& piece);

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
