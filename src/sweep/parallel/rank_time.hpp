#pragma once
// Time constants of the ranks: polling, heartbeats and timeouts.

#include <algorithm>
#include <chrono>
#include <cstdint>

namespace corpuscle {

using RankTime = std::chrono::steady_clock::time_point;
inline RankTime rank_time() { return std::chrono::steady_clock::now(); }
inline double seconds_between(RankTime from, RankTime to) { return std::chrono::duration<double>(to - from).count(); }

inline constexpr std::chrono::milliseconds rank_tick{1};  // time between two rounds of polling for messages
inline constexpr double heartbeat_interval = 1;           // s; a rank that has sent no message for this time sends a heartbeat
// s; a rank without messages for this time counts as dead. On the same machine, the end of its process is noticed at once.
inline constexpr double rank_timeout = 20;

/// Measures how fast a rank finishes items. From this follows how many items should wait at the rank: enough for half a second, so that the
/// rank does not wait for requested items, and enough to fill its lanes.
class RankThroughput {
    RankTime since_ = rank_time();  // start of the present interval
    std::size_t finished_ = 0;      // items in this interval
    double rate_ = 0;               // items per second, a moving average over intervals; 0: not yet measured

public:
    /// Counts items that were finished since the last call. `now`: rank_time().
    void add_finished(std::size_t items, RankTime now) {
        constexpr double min_seconds = 0.1;  // shortest interval
        constexpr double weight = 0.3;       // of the newest interval in the average
        finished_ += items;
        const double seconds = seconds_between(since_, now);
        if (seconds < min_seconds) return;
        const double rate = static_cast<double>(finished_) / seconds;
        rate_ = rate_ == 0 ? rate : rate_ + weight * (rate - rate_);
        since_ = now, finished_ = 0;
    }
    /// The number of items that should wait at the rank. `threads`: of the rank.
    std::int64_t queue_target(unsigned threads) const {
        constexpr double seconds = 0.5;
        constexpr std::int64_t lanes = 8, max = 1 << 14;  // items for each thread, at least; items in total, at most
        return std::clamp<std::int64_t>(static_cast<std::int64_t>(rate_ * seconds), lanes * threads, max);
    }
};

}  // namespace corpuscle
