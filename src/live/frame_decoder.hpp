#pragma once
// Frames out of bytes, which come in pieces of any size. Allocates nothing once it is made, but for a header.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "live/frame_layout.hpp"
#include "live/frame_misfit.hpp"
#include "live/header_reader.hpp"
#include "live/lanes/kernel.hpp"

namespace corpuscle {

class FrameDecoder {
public:
    enum class Found { nothing, frame, unreadable };

private:
    FrameLayout layout_;
    const lanes::FrameLanes& lanes_;
    std::vector<char> bytes_;
    std::size_t begin_ = 0, end_ = 0;  // of what came and was not yet taken
    std::size_t looked_ = 0;           // up to here there is no end of a line
    bool skipping_ = false;            // a line that is longer than any frame: to its end
    bool first_ = true;                // nothing was read yet: a header may come
    const char* found_ = nullptr;      // a binary frame's forces
    std::vector<double> values_;       // of a line
    HeaderReader read_header_;
    std::vector<std::uint32_t> places_;  // of a line's numbers among the values; none: their order
    std::optional<Error> refused_;       // the header of this sender
    std::uint32_t number_ = 0;
    std::int64_t headers_ = 0, seen_ = 0;  // seen: frames, read or not
    std::optional<FrameMisfit> misfit_;

    Found unreadable(FrameMisfit::Why, std::size_t found = 0);
    bool is_header(std::string_view line) const;
    void take_header(std::string_view line);
    Found read_line(std::string_view line);
    bool read_stamp(double seconds);
    bool read_stamp(std::string_view text);

public:
    /// There is always room for so many more frames.
    explicit FrameDecoder(const FrameLayout&, std::size_t frames = 1, HeaderReader = {});
    const FrameLayout& layout() const { return layout_; }

    std::span<char> room();                                    ///< where the next bytes go; never empty
    void came(std::size_t bytes) { end_ += bytes; }            ///< so many have come there
    bool begun() const { return end_ > begin_ || skipping_; }  ///< part of a frame is there
    /// So many have come there as one datagram, which must hold whole frames: the last line needs no end. False: it is none, and is left.
    bool came_datagram(std::size_t bytes);
    std::size_t begun_bytes() const { return end_ - begin_; }  ///< of the part of a frame that is there
    void forget();                                             ///< whoever sent it is gone

    /// Looks for the next whole frame; the bytes that it took are gone then.
    Found next();
    std::uint32_t number() const { return number_; }                            ///< of the one found, modulo 2^32, where frames are stamped
    const std::optional<Error>& refused_header() const { return refused_; }     ///< the frames behind it cannot be read
    std::int64_t headers() const { return headers_; }                           ///< first lines that were names, not numbers
    const std::optional<FrameMisfit>& first_misfit() const { return misfit_; }  ///< the first frame that could not be read
    /// The forces of the one found, in place of those that were. What is no number or beyond the limit stays as it was; returns how
    /// many of those there were.
    std::size_t take(std::span<double> force) const;
};

}  // namespace corpuscle
