#pragma once
// Reasons why a frame could not be read.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace corpuscle {

struct FrameLayout;

struct FrameError {
    enum Reason {
        width,     ///< the line has the wrong number of fields: `found`
        stamp,     ///< its stamp is not a valid number or time
        too_long,  ///< a line is longer than any frame
        datagram,  ///< a datagram of `found` bytes does not contain whole frames
        header,    ///< the header before it was refused: `detail`
    } reason = width;
    std::int64_t frame = 1;  ///< number of the frame, from 1
    std::size_t found = 0;
    std::string detail = {};
};

/// "frame 1 has 16 numbers; 'hand' has 4793 sites, so a frame must have 4793 numbers"
std::string describe_frame_error(const FrameError&, const FrameLayout&, std::string_view population);

}  // namespace corpuscle
