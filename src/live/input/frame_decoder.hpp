#pragma once
// Decodes frames from bytes, which arrive in chunks of any size. After construction it allocates memory only for a header, for comments
// before the first frame of a sender, and for the first line, which may be one.

#include "live/input/frame_layout.hpp"
#include "live/lanes/kernel.hpp"

namespace corpuscle {

/// Bytes are written to buffer() and announced by add_bytes() or add_datagram(). Then next() is called until it returns `nothing`.
class FrameDecoder {
public:
    /// Result of next(): no complete frame has arrived, a frame was found, or a frame was found that cannot be read.
    enum class Status { nothing, frame, unreadable };

private:
    /// Neighbouring values with the same scale.
    struct ScaleRun {
        std::size_t begin, end;
        double scale;
    };

    FrameLayout layout_;
    const lanes::FrameKernels& lanes_;
    std::vector<char> bytes_;          // the buffer
    std::size_t begin_ = 0, end_ = 0;  // positions in bytes_: [begin_, end_) has arrived and is not decoded yet
    std::size_t scanned_ = 0;          // [begin_, scanned_) contains no line end
    bool skipping_ = false;            // true: the beginning of a line was discarded, because the line is longer than any frame
    bool first_ = true;                // true: no line of this sender has been read, so the next one may be a header
    const char* found_ = nullptr;      // values of the found frame, if frames are binary
    std::vector<double> values_;       // values of the found frame, if frames are lines
    HeaderReader read_header_;
    std::string comment_;                     // the last comment before the first line of this sender; it may be the header
    std::vector<std::uint32_t> value_index_;  // for each number of a line its index in values_; empty: in order
    std::vector<ScaleRun> scale_runs_;        // the scales of the header, in the order of values_; empty: that of the layout
    std::optional<Error> header_error_;       // error in the header of this sender
    std::uint32_t number_ = 0;                // see number()
    std::int64_t headers_ = 0, seen_ = 0;     // numbers of headers and of frames, readable or not, of all senders
    std::optional<FrameError> first_error_;

    Status unreadable(FrameError::Reason, std::size_t found = 0);
    bool take_header(std::string_view line, bool is_comment = false);
    void read_header(const std::vector<std::string>& names);
    Status wrong_width(std::string_view line);
    Status read_line(std::string_view line);
    bool read_stamp(double seconds);
    bool read_stamp(std::string_view text);

public:
    /// The size of the buffer follows from `frames`, the number of frames that are read at once.
    explicit FrameDecoder(const FrameLayout&, std::size_t frames = 1, HeaderReader = {});
    const FrameLayout& layout() const { return layout_; }

    std::span<char> buffer();                                              ///< destination of the next bytes; never empty
    void add_bytes(std::size_t bytes) { end_ += bytes; }                   ///< call after writing `bytes` bytes to buffer()
    bool has_partial_frame() const { return end_ > begin_ || skipping_; }  ///< true if part of a frame has arrived
    /// Call after writing a datagram of `bytes` bytes to buffer(). It must consist of whole frames; its last line needs no line
    /// end, for which there must be space in the buffer. If frames are binary and not whole, ignores the datagram and returns false.
    bool add_datagram(std::size_t bytes);
    std::size_t partial_bytes() const { return end_ - begin_; }  ///< bytes of a partial frame that have arrived
    void reset();  ///< discards all bytes and the header; call it after the sender has disconnected

    /// Finds the next complete frame and consumes its bytes.
    Status next();
    /// The number of the found frame, modulo 2^32, if frames have a stamp. A time becomes a number by FrameLayout::rate.
    std::uint32_t number() const { return number_; }
    /// If set, this sender's header was refused, and its frames are unreadable.
    const std::optional<Error>& header_error() const { return header_error_; }
    std::int64_t headers() const { return headers_; }  ///< number of first lines that contained names instead of numbers
    const std::optional<FrameError>& first_error() const { return first_error_; }  ///< the first frame that could not be read
    /// Writes the forces of the found frame to `force` (N). If a force is NaN or beyond the limit, or its value out of range, the element
    /// of `force` is not changed. Returns the number of such forces.
    std::size_t read_forces(std::span<double> force) const;
};

}  // namespace corpuscle
