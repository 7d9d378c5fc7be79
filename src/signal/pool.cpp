#include "signal/pool.hpp"

#include <algorithm>
#include <utility>

namespace corpuscle {

Pool::Pool(unsigned threads) {
    const unsigned all = threads > 0 ? threads : std::max(1U, std::thread::hardware_concurrency());
    for (unsigned t = 1; t < all; ++t) helpers_.emplace_back([this, t] { help(t); });
}

Pool::~Pool() {
    {
        const std::lock_guard lock(guard_);
        closing_ = true;
    }
    begun_.notify_all();
    for (auto& h : helpers_) h.join();
}

void Pool::each(std::size_t count, const Piece& task) {
    if (helpers_.empty()) {  // without a lock, to keep the overhead small
        for (std::size_t k = 0; k < count; ++k) task(k, 0);
        return;
    }
    const bool is_single = count < 2;
    {
        const std::lock_guard lock(guard_);
        piece_ = &task, count_ = count, next_ = 0;
        if (!is_single) ++round_, helping_ = helpers_.size();
    }
    if (!is_single) begun_.notify_all();
    work(0);
    std::unique_lock lock(guard_);
    ended_.wait(lock, [this] { return helping_ == 0; });
    if (failed_) std::rethrow_exception(std::exchange(failed_, nullptr));
}

void Pool::help(unsigned thread) {
    for (std::size_t seen = 0;;) {
        {
            std::unique_lock lock(guard_);
            begun_.wait(lock, [&] { return closing_ || round_ != seen; });
            if (closing_) return;
            seen = round_;
        }
        work(thread);
        const std::lock_guard lock(guard_);
        if (--helping_ == 0) ended_.notify_one();
    }
}

void Pool::work(unsigned thread) {
    for (std::size_t k = next_++; k < count_; k = next_++) try {
            (*piece_)(k, thread);
        } catch (...) {
            const std::lock_guard lock(guard_);
            failed_ = std::current_exception();
            next_ = count_;
        }
}

}  // namespace corpuscle
