#pragma once
// Why a frame could not be read.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace corpuscle {

struct FrameLayout;

struct FrameMisfit {
    enum Why {
        width,     ///< a line of `found` fields
        stamp,     ///< its stamp is no count, or no time
        endless,   ///< a line longer than any frame
        datagram,  ///< a datagram of `found` bytes, which are no whole number of frames
        header,    ///< the header above it was refused: `detail`
    } why = width;
    std::int64_t frame = 1;  ///< which frame it was, from 1
    std::size_t found = 0;
    std::string detail = {};
};

/// "frame 1 has 16 numbers; 'hand' has 4793 sites, and a frame one number for each"
std::string text_of(const FrameMisfit&, const FrameLayout&, std::string_view population);

}  // namespace corpuscle
