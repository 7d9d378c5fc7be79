#pragma once
// Binary and text layout of one frame of forces (doc/live.md).

#include <cstddef>
#include <cstdint>

namespace corpuscle {

enum class FrameKind { csv, f32, f64, i16 };

/// The data before the forces of a frame: none, its number (u32 if binary), or its time in seconds (f64 if binary).
enum class FrameStamp { none, sequence, time };

struct FrameLayout {
    FrameKind kind = FrameKind::csv;
    FrameStamp stamp = FrameStamp::none;
    std::size_t sites = 1;
    double rate = 1000;            ///< Hz: converts a stamped time to a frame number
    double scale = 1, offset = 0;  ///< force (N) = (value - offset) * scale
    double limit = 1000;           ///< N; a force of larger magnitude is not a valid reading
    std::size_t stamp_bytes() const { return stamp == FrameStamp::none ? 0 : stamp == FrameStamp::sequence ? 4 : 8; }
    std::size_t value_bytes() const { return kind == FrameKind::i16 ? 2 : kind == FrameKind::f32 ? 4 : 8; }
    std::size_t bytes() const { return stamp_bytes() + sites * value_bytes(); }  ///< of a binary frame
};

}  // namespace corpuscle
