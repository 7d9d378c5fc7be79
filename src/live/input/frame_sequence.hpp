#pragma once
// The order of numbered frames: decides what is done about gaps, duplicates and late frames (doc/live.md).

#include <cstdint>

namespace corpuscle {

/// Statistics of numbered frames.
struct SequenceCounts {
    std::int64_t gaps = 0;        ///< number of gaps, each of one or more missing frames
    std::int64_t held = 0;        ///< number of missing frames that were replaced by frames with the last force
    std::int64_t released = 0;    ///< number of missing frames that were replaced by frames without force
    std::int64_t duplicates = 0;  ///< number of frames that repeat the number of the last one; ignored
    std::int64_t late = 0;        ///< number of frames with a number below the last one by at most max_gap; ignored
    std::int64_t restarts = 0;    ///< number of jumps by more than max_gap: treated as a restart of the sender, without inserting frames
};

/// Keeps the number of the last frame, and decides about the next one.
class FrameSequence {
    std::int64_t hold_, max_gap_;  // numbers of frames
    bool begun_ = false;           // false: the next frame is the first one of a sender
    std::uint32_t last_ = 0;       // number of the last frame that was taken
    SequenceCounts counts_;

public:
    /// The first `hold` missing frames of a gap are replaced by frames with the last force, further ones by frames without force. A gap of
    /// more than `max_gap` frames is treated as a restart of the sender.
    FrameSequence(std::int64_t hold, std::int64_t max_gap) : hold_(hold), max_gap_(max_gap) {}

    struct FrameDecision {
        bool take = true;                    ///< false: the frame is ignored
        std::int64_t hold = 0, release = 0;  ///< numbers of frames to insert before it: with the last force, then without force
    };

    /// Decides about a frame by its number, modulo 2^32, and counts it in counts().
    FrameDecision decide(std::uint32_t number) {
        // Difference from the number of the last frame, modulo 2^32: 1 for the next frame.
        const std::int64_t ahead = begun_ ? static_cast<std::int32_t>(number - last_) : 1;
        if (ahead == 0) return ++counts_.duplicates, FrameDecision{false};
        if (ahead < 0 && -ahead <= max_gap_) return ++counts_.late, FrameDecision{false};
        begun_ = true, last_ = number;
        if (ahead == 1) return {};
        if (ahead < 0 || ahead - 1 > max_gap_) return ++counts_.restarts, FrameDecision{};
        const auto held = ahead - 1 < hold_ ? ahead - 1 : hold_;
        ++counts_.gaps, counts_.held += held, counts_.released += ahead - 1 - held;
        return {true, held, ahead - 1 - held};
    }

    /// Call when another sender begins: its first frame is accepted as the next one, regardless of its number.
    void restart() { begun_ = false; }
    /// Continues as if a frame with this number had been the last one.
    void resume_after(std::uint32_t number) { begun_ = true, last_ = number; }
    bool has_begun() const { return begun_; }
    std::uint32_t last() const { return last_; }
    const SequenceCounts& counts() const { return counts_; }
};

}  // namespace corpuscle
