#pragma once
// When ranks look, speak, and take one another for dead.

#include <algorithm>
#include <chrono>
#include <cstdint>

namespace corpuscle {

using RankTime = std::chrono::steady_clock::time_point;
inline RankTime rank_time() { return std::chrono::steady_clock::now(); }
inline double seconds_between(RankTime from, RankTime to) { return std::chrono::duration<double>(to - from).count(); }

inline constexpr std::chrono::milliseconds rank_tick{1};
inline constexpr double between_beats = 1;     // s
inline constexpr double longest_silence = 20;  // s; of one on the same machine death is seen at once

/// How many units should wait at a rank: half a second's work, so that asking takes no time from it, and as many as fill its lanes.
class RankPace {
    RankTime since_ = rank_time();
    std::size_t ended_ = 0;
    double rate_ = 0;  // units a second

public:
    void ended(std::size_t units, RankTime now) {
        constexpr double long_enough = 0.1, new_share = 0.3;
        ended_ += units;
        const double seconds = seconds_between(since_, now);
        if (seconds < long_enough) return;
        const double rate = static_cast<double>(ended_) / seconds;
        rate_ = rate_ == 0 ? rate : rate_ + new_share * (rate - rate_);
        since_ = now, ended_ = 0;
    }
    std::int64_t ahead(unsigned threads) const {
        constexpr double seconds = 0.5;
        constexpr std::int64_t lanes = 8, most = 1 << 14;
        return std::clamp<std::int64_t>(static_cast<std::int64_t>(rate_ * seconds), lanes * threads, most);
    }
};

}  // namespace corpuscle
