#pragma once
// What one frame of forces is on the wire (doc/live.md).

#include <cstddef>
#include <cstdint>

namespace corpuscle {

enum class FrameKind { csv, f32, f64, i16 };

/// What stands before a frame's forces: nothing; its number (binary: u32); or its time in seconds (binary: f64).
enum class FrameStamp { none, count, time };

struct FrameLayout {
    FrameKind kind = FrameKind::csv;
    FrameStamp stamp = FrameStamp::none;
    std::size_t sites = 1;
    double rate = 1000;            ///< Hz: what turns a stamped time into a number
    double scale = 1, offset = 0;  ///< force (N) = (what is read - offset) * scale
    double limit = 1000;           ///< N: what is above is no reading
    std::size_t stamp_bytes() const { return stamp == FrameStamp::none ? 0 : stamp == FrameStamp::count ? 4 : 8; }
    std::size_t value_bytes() const { return kind == FrameKind::i16 ? 2 : kind == FrameKind::f32 ? 4 : 8; }
    std::size_t bytes() const { return stamp_bytes() + sites * value_bytes(); }  ///< of a binary frame
};

}  // namespace corpuscle
