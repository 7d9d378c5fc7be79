#pragma once
// Threads that compute work items and return the outcomes.

#include <atomic>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

#include "study/sweep/sweep.hpp"

namespace corpuscle {

/// One thread adds items and collects outcomes. `threads` worker threads each run Sweep::work while there are items.
class Crew {
public:
    Crew(const Sweep&, unsigned threads);
    ~Crew();  ///< discards unfinished items
    Crew(const Crew&) = delete;
    Crew& operator=(const Crew&) = delete;

    void give(const std::vector<std::int64_t>& units);
    /// Removes items that have not started. Items in progress end as soon as the sweep can be stopped.
    void stop();

    /// Outcomes since the last call. Waits up to this time (s), but returns at once if there are many or if no thread is working.
    std::vector<UnitOutcome> collect(double seconds);
    std::size_t waiting() const;  ///< items that have not started
    bool is_done() const;         ///< all items are finished and collected
    /// The error in the sweep itself, if there was one.
    Result<void> fault() const;

    /// Threads wait if the uncollected outcomes exceed this size, bytes.
    static constexpr std::size_t most_held = std::size_t{32} << 20, much = most_held / 4;

private:
    void work();
    std::optional<std::int64_t> next();
    void tell(UnitOutcome&&);

    const Sweep& sweep_;
    mutable std::mutex guard_;
    std::condition_variable given_, told_, room_;
    std::deque<std::int64_t> units_;
    std::vector<UnitOutcome> outcomes_;
    std::size_t held_ = 0;  // size of outcomes_, bytes
    unsigned working_ = 0;
    std::atomic<bool> stopping_ = false;
    bool closing_ = false;
    Result<void> fault_;
    std::vector<std::thread> threads_;
};

}  // namespace corpuscle
