#pragma once
// Time constants of the ranks: polling, heartbeats and timeouts.

#include <algorithm>
#include <chrono>
#include <cstdint>

namespace corpuscle {

using RankTime = std::chrono::steady_clock::time_point;
inline RankTime rank_time() { return std::chrono::steady_clock::now(); }
inline double seconds_between(RankTime from, RankTime to) { return std::chrono::duration<double>(to - from).count(); }

inline constexpr std::chrono::milliseconds rank_tick{1};
inline constexpr double heartbeat_interval = 1;  // s
inline constexpr double rank_timeout = 20;       // s; a rank that dies on the same machine is noticed at once

/// Number of items to keep queued at a rank: half a second's work, so that requests cost no time, and enough to fill its lanes.
class RankThroughput {
    RankTime since_ = rank_time();
    std::size_t finished_ = 0;
    double rate_ = 0;  // items a second

public:
    void add_finished(std::size_t items, RankTime now) {
        constexpr double min_seconds = 0.1, weight = 0.3;
        finished_ += items;
        const double seconds = seconds_between(since_, now);
        if (seconds < min_seconds) return;
        const double rate = static_cast<double>(finished_) / seconds;
        rate_ = rate_ == 0 ? rate : rate_ + weight * (rate - rate_);
        since_ = now, finished_ = 0;
    }
    std::int64_t queue_target(unsigned threads) const {
        constexpr double seconds = 0.5;
        constexpr std::int64_t lanes = 8, max = 1 << 14;
        return std::clamp<std::int64_t>(static_cast<std::int64_t>(rate_ * seconds), lanes * threads, max);
    }
};

}  // namespace corpuscle
