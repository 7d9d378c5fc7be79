#pragma once
// Frames out of bytes, which come in pieces of any size. Allocates nothing once it is made.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "live/frame_layout.hpp"
#include "live/lanes/kernel.hpp"

namespace corpuscle {

class FrameDecoder {
    FrameLayout layout_;
    const lanes::FrameLanes& lanes_;
    std::vector<char> bytes_;
    std::size_t begin_ = 0, end_ = 0;  // of what came and was not yet taken
    std::size_t looked_ = 0;           // up to here there is no end of a line
    bool skipping_ = false;            // a line that is longer than any frame: to its end
    bool first_ = true;                // nothing was read yet: a header may come
    const char* found_ = nullptr;      // a binary frame's forces
    std::vector<double> values_;       // of a line
    std::uint32_t number_ = 0;
    std::int64_t headers_ = 0;

    bool is_header(std::string_view line) const;
    bool read_line(std::string_view line);
    bool read_stamp(double seconds);
    bool read_stamp(std::string_view text);

public:
    enum class Found { nothing, frame, unreadable };

    /// There is always room for so many more frames.
    explicit FrameDecoder(const FrameLayout&, std::size_t frames = 1);
    const FrameLayout& layout() const { return layout_; }

    std::span<char> room();                                    ///< where the next bytes go; never empty
    void came(std::size_t bytes) { end_ += bytes; }            ///< so many have come there
    bool begun() const { return end_ > begin_ || skipping_; }  ///< part of a frame is there
    void forget();                                             ///< whoever sent it is gone

    /// Looks for the next whole frame; the bytes that it took are gone then.
    Found next();
    std::uint32_t number() const { return number_; }   ///< of the one found, modulo 2^32, where frames are stamped
    std::int64_t headers() const { return headers_; }  ///< first lines that were names, not numbers
    /// The forces of the one found, in place of those that were. What is no number or beyond the limit stays as it was; returns how
    /// many of those there were.
    std::size_t take(std::span<double> force) const;
};

}  // namespace corpuscle
