#pragma once
// The frames of a stream (doc/live.md): the layout of one frame of forces, binary or text, and the order of numbered frames. Also the
// reason why a frame could not be read.

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
    std::string_view site_noun = "site";  ///< in messages; "taxel" or "axis" if the forces are those of taxels
    std::size_t stamp_bytes() const { return stamp == FrameStamp::none ? 0 : stamp == FrameStamp::sequence ? 4 : 8; }
    std::size_t value_bytes() const { return kind == FrameKind::i16 ? 2 : kind == FrameKind::f32 ? 4 : 8; }
    std::size_t bytes() const { return stamp_bytes() + sites * value_bytes(); }  ///< size of a binary frame
};

/// The columns of CSV frames without the stamp, as their header describes them.
struct FrameColumns {
    std::vector<std::uint32_t> order;  ///< for each column the index of its force in the frame; empty: in the order of the frame
    std::vector<double> scales = {};   ///< for each column newtons per unit of its readings; empty: FrameLayout::scale
};

/// Interprets the header of CSV frames, a first line that contains names instead of numbers. `names` are those of the columns, without that
/// of the stamp. Names that are refused are an error.
using HeaderReader = std::function<Result<FrameColumns>(std::span<const std::string> names)>;

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
    bool has_decimal_commas = false;  ///< with `width`: the width is right if the commas of the line are decimal commas
};

/// The message for an error: "frame 1 has 16 numbers; 'hand' has 4793 sites, so a frame must have 4793 numbers". `population` is the name
/// of the population, or of the file of its taxels.
std::string describe_frame_error(const FrameError&, const FrameLayout&, std::string_view population);

/// Statistics of numbered frames.
struct SequenceCounts {
    std::int64_t gaps = 0;        ///< number of gaps, each of one or more missing frames
    std::int64_t held = 0;        ///< number of missing frames that were replaced by frames with the last force
    std::int64_t released = 0;    ///< number of missing frames that were replaced by frames without force
    std::int64_t duplicates = 0;  ///< number of frames that repeat the number of the last one; ignored
    std::int64_t late = 0;        ///< number of frames with a number below the last one by at most max_gap; ignored
    std::int64_t restarts = 0;    ///< number of jumps by more than max_gap: treated as a restart of the sender, without inserting frames
};

/// Keeps the number of the last frame, and decides about the next one: what is done about gaps, duplicates and late frames.
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
