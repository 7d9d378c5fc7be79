#pragma once
// Which frame comes when, of frames that are numbered: the policy for gaps, duplicates and late ones (doc/live.md).

#include <cstdint>

namespace corpuscle {

/// What became of numbered frames.
struct OrderCounts {
    std::int64_t gaps = 0;        ///< stretches in which frames are missing
    std::int64_t held = 0;        ///< missing frames in whose place the last force was held
    std::int64_t released = 0;    ///< missing frames beyond those, in whose place there was no force
    std::int64_t duplicates = 0;  ///< frames that had come before, left out
    std::int64_t late = 0;        ///< frames whose place was filled, or that are older than the last: left out
    std::int64_t restarts = 0;    ///< numbers too far from the last: the count begins anew, and time goes on with the next frame
};

class FrameOrder {
    std::int64_t hold_, longest_;  // frames
    bool begun_ = false;
    std::uint32_t last_ = 0;
    OrderCounts counts_;

public:
    /// A gap's first `hold` frames hold the last force; one of more than `longest` is none, but the count begun anew.
    FrameOrder(std::int64_t hold, std::int64_t longest) : hold_(hold), longest_(longest) {}

    struct Turn {
        bool take = true;                    ///< false: it is left out
        std::int64_t hold = 0, release = 0;  ///< frames to be put before it
    };

    /// Numbers are modulo 2^32.
    Turn turn(std::uint32_t number) {
        const std::int64_t ahead = begun_ ? static_cast<std::int32_t>(number - last_) : 1;
        if (ahead == 0) return ++counts_.duplicates, Turn{false};
        if (ahead < 0 && -ahead <= longest_) return ++counts_.late, Turn{false};
        begun_ = true, last_ = number;
        if (ahead == 1) return {};
        if (ahead < 0 || ahead - 1 > longest_) return ++counts_.restarts, Turn{};
        const auto held = ahead - 1 < hold_ ? ahead - 1 : hold_;
        ++counts_.gaps, counts_.held += held, counts_.released += ahead - 1 - held;
        return {true, held, ahead - 1 - held};
    }

    /// Another begins to send: its first number is the next frame's, whatever it is.
    void begin_anew() { begun_ = false; }
    /// As after a frame of this number.
    void go_on_from(std::uint32_t number) { begun_ = true, last_ = number; }
    bool begun() const { return begun_; }
    std::uint32_t last() const { return last_; }
    const OrderCounts& counts() const { return counts_; }
};

}  // namespace corpuscle
