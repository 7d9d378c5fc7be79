#pragma once
// Decodes frames from bytes, which arrive in chunks of any size. After construction it allocates only for a header.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "live/frame_error.hpp"
#include "live/frame_layout.hpp"
#include "live/header_reader.hpp"
#include "live/lanes/kernel.hpp"

namespace corpuscle {

class FrameDecoder {
public:
    enum class Status { nothing, frame, unreadable };

private:
    FrameLayout layout_;
    const lanes::FrameKernels& lanes_;
    std::vector<char> bytes_;
    std::size_t begin_ = 0, end_ = 0;  // bytes that have arrived and are not decoded yet
    std::size_t scanned_ = 0;          // no line end before this position
    bool skipping_ = false;            // skipping a line that is longer than any frame
    bool first_ = true;                // nothing has been read yet: a header may come
    const char* found_ = nullptr;      // forces of the found frame, if frames are binary
    std::vector<double> values_;       // numbers of the found line
    HeaderReader read_header_;
    std::vector<std::uint32_t> value_index_;  // index into the values for each number of a line; empty: in order
    std::optional<Error> header_error_;       // error in the header of this sender
    std::uint32_t number_ = 0;
    std::int64_t headers_ = 0, seen_ = 0;  // seen_: frames, readable or not
    std::optional<FrameError> first_error_;

    Status unreadable(FrameError::Reason, std::size_t found = 0);
    bool is_header(std::string_view line) const;
    void read_header(std::string_view line);
    Status read_line(std::string_view line);
    bool read_stamp(double seconds);
    bool read_stamp(std::string_view text);

public:
    /// The buffer always has space for `frames` further frames.
    explicit FrameDecoder(const FrameLayout&, std::size_t frames = 1, HeaderReader = {});
    const FrameLayout& layout() const { return layout_; }

    std::span<char> buffer();                                              ///< destination of the next bytes; never empty
    void add_bytes(std::size_t bytes) { end_ += bytes; }                   ///< call when `bytes` have been written to buffer()
    bool has_partial_frame() const { return end_ > begin_ || skipping_; }  ///< part of a frame has arrived
    /// The same for one datagram of `bytes`. It must contain whole frames; its last line needs no line end. Returns false, and ignores the
    /// datagram, if its frames are not whole.
    bool add_datagram(std::size_t bytes);
    std::size_t partial_bytes() const { return end_ - begin_; }  ///< size of the partial frame
    void reset();                                                ///< discards everything, because the sender has disconnected

    /// Finds the next complete frame and consumes its bytes.
    Status next();
    /// Number of the found frame, modulo 2^32, if frames are stamped.
    std::uint32_t number() const { return number_; }
    const std::optional<Error>& header_error() const { return header_error_; }     ///< if set, the frames after it cannot be read
    std::int64_t headers() const { return headers_; }                              ///< first lines that were names, not numbers
    const std::optional<FrameError>& first_error() const { return first_error_; }  ///< the first frame that could not be read
    /// Writes the forces of the found frame over the last ones. A value that is NaN or beyond the limit is not written; returns the number
    /// of such values.
    std::size_t read_forces(std::span<double> force) const;
};

}  // namespace corpuscle
