#pragma once
// The order of numbered frames: the policy for gaps, duplicates and late frames (doc/live.md).

#include <cstdint>

namespace corpuscle {

/// Statistics of numbered frames.
struct OrderCounts {
    std::int64_t gaps = 0;        ///< gaps in the sequence
    std::int64_t held = 0;        ///< missing frames that were replaced by the last force
    std::int64_t released = 0;    ///< further missing frames, replaced by zero force
    std::int64_t duplicates = 0;  ///< frames received before; ignored
    std::int64_t late = 0;        ///< frames older than the last one, or already replaced; ignored
    std::int64_t restarts = 0;    ///< jumps larger than the limit: treated as a restart of the sender, without inserting frames
};

class FrameOrder {
    std::int64_t hold_, longest_;  // frames
    bool begun_ = false;
    std::uint32_t last_ = 0;
    OrderCounts counts_;

public:
    /// The first `hold` missing frames of a gap repeat the last force. A gap of more than `max_gap` frames is treated as a restart of the
    /// sender.
    FrameOrder(std::int64_t hold, std::int64_t max_gap) : hold_(hold), longest_(max_gap) {}

    struct Turn {
        bool take = true;                    ///< false: the frame is ignored
        std::int64_t hold = 0, release = 0;  ///< frames to insert before it: with the last force, then with none
    };

    /// Frame numbers are modulo 2^32.
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

    /// Call when another sender begins: its first frame is the next one, whatever its number.
    void begin_anew() { begun_ = false; }
    /// Continues as after a frame with this number.
    void go_on_from(std::uint32_t number) { begun_ = true, last_ = number; }
    bool begun() const { return begun_; }
    std::uint32_t last() const { return last_; }
    const OrderCounts& counts() const { return counts_; }
};

}  // namespace corpuscle
