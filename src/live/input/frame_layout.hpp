#pragma once
// The layout of one frame of forces, binary or text (doc/live.md), and the reason why a frame could not be read.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "core/error.hpp"

namespace corpuscle {

/// The type of a frame's values: numbers in a line of text, or binary float, double or 16-bit integer.
enum class FrameKind { csv, f32, f64, i16 };

/// The data before the forces of a frame: none, its number (u32 if binary), or its time in seconds (f64 if binary).
enum class FrameStamp { none, sequence, time };

struct FrameLayout {
    FrameKind kind = FrameKind::csv;
    FrameStamp stamp = FrameStamp::none;
    std::size_t sites = 1;         ///< number of forces in a frame
    double rate = 1000;            ///< frames per second; a frame with a time stamp gets the number time * rate, rounded
    double scale = 1, offset = 0;  ///< force (N) = (value - offset) * scale
    double limit = 1000;           ///< N; a force of larger magnitude is not a valid reading
    bool absolute = false;         ///< the absolute value of each value is used
    /// Lowest and highest valid value, after `absolute`. Others are not valid readings.
    std::optional<std::pair<double, double>> range = {};
    std::size_t stamp_bytes() const { return stamp == FrameStamp::none ? 0 : stamp == FrameStamp::sequence ? 4 : 8; }
    std::size_t value_bytes() const { return kind == FrameKind::i16 ? 2 : kind == FrameKind::f32 ? 4 : 8; }
    std::size_t bytes() const { return stamp_bytes() + sites * value_bytes(); }  ///< size of a binary frame
};

/// Interprets the header of CSV frames, a first line that contains names instead of numbers. For each name, without that of the stamp,
/// returns the index of the force in the frame to which the numbers of this column belong. An empty result means that the columns are in
/// the order of the frame. Names that are refused are an error.
using HeaderReader = std::function<Result<std::vector<std::uint32_t>>(std::span<const std::string> names)>;

/// The reason why a frame could not be read.
struct FrameError {
    enum Reason {
        width,     ///< the line has `found` fields, which is the wrong number
        stamp,     ///< the frame's stamp is not a valid number or time
        too_long,  ///< the line is longer than a frame can be
        datagram,  ///< a datagram of `found` bytes does not consist of whole frames
        header,    ///< the header before the frame was refused; `detail` is the message
    } reason = width;
    std::int64_t frame = 1;  ///< number of the frame among all that have arrived, from 1
    std::size_t found = 0;
    std::string detail = {};
};

/// The message for an error: "frame 1 has 16 numbers; 'hand' has 4793 sites, so a frame must have 4793 numbers". `population` is the name
/// of the population.
std::string describe_frame_error(const FrameError&, const FrameLayout&, std::string_view population);

}  // namespace corpuscle
