#pragma once
// Threads that work on the units they are given, and hand in what came out.

#include <atomic>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

#include "study/sweep/sweep.hpp"

namespace corpuscle {

/// One thread gives units and collects outcomes; `threads` others are each in a call of Sweep::work, as long as there are units.
class Crew {
public:
    Crew(const Sweep&, unsigned threads);
    ~Crew();  ///< leaves what is not done
    Crew(const Crew&) = delete;
    Crew& operator=(const Crew&) = delete;

    void give(const std::vector<std::int64_t>& units);
    /// What is not begun is taken away; what is begun is left where the sweep can be stopped.
    void stop();

    /// What has come out since, after this time at the most (s), at once if that is much or nobody is at work.
    std::vector<UnitOutcome> collect(double seconds);
    std::size_t waiting() const;  ///< units that nobody has begun
    bool is_done() const;         ///< nothing given is left, nobody is at work, and all is collected
    /// What was wrong with the sweep itself, if anything was.
    Result<void> fault() const;

    /// Bytes of outcomes at which the threads wait until they are collected.
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
    std::size_t held_ = 0;  // bytes in outcomes_
    unsigned working_ = 0;
    std::atomic<bool> stopping_ = false;
    bool closing_ = false;
    Result<void> fault_;
    std::vector<std::thread> threads_;
};

}  // namespace corpuscle
