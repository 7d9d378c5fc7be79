#pragma once
// The reason why a frame could not be read.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace corpuscle {

struct FrameLayout;

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
