#pragma once
// Sources of a stream's frames: bytes in a given layout, or a recording in real time.

#include <memory>
#include <optional>
#include <span>

#include "live/byte_source.hpp"
#include "live/frame_error.hpp"
#include "live/frame_layout.hpp"
#include "live/frame_sequence.hpp"
#include "live/header_reader.hpp"
#include "live/steady_clock.hpp"
#include "signal/force_source.hpp"

namespace corpuscle {

struct FrameCounts {
    std::int64_t frames = 0;          ///< received and simulated
    std::int64_t unreadable = 0;      ///< unreadable frames: the last force was repeated (for numbered frames: a gap)
    std::int64_t invalid_values = 0;  ///< values that are NaN or beyond the limit: the site kept its last force
    std::int64_t partial_frames = 0;  ///< frames that were incomplete when their sender disconnected
    std::int64_t partial_bytes = 0;   ///< bytes of the last of these
    std::int64_t headers = 0;         ///< first lines that were names
    std::int64_t sender_count = 0;    ///< senders so far
    SenderCounts senders = {};        ///< senders on a network
    SequenceCounts sequence = {};     ///< numbered frames
};

class FrameSource {
public:
    static constexpr std::int64_t never = steady_never;
    enum class Next {
        nothing,  ///< none yet
        frame,    ///< a received frame
        filled,   ///< a replacement for a missing or unreadable frame
    };

    virtual ~FrameSource() = default;
    virtual int poll_fd() const { return -1; }               ///< descriptor to poll for reading; -1: driven by the clock
    virtual std::int64_t due_time() const { return never; }  ///< time of the next frame that needs no poll; steady_now()
    virtual Result<bool> receive() = 0;                      ///< reads what has arrived; false: no more data
    virtual void disable_batching() {}                       ///< makes reads return as soon as any bytes have arrived
    virtual Next next(std::span<double> force) = 0;          ///< `force` (N) is the last frame; overwrites it with the next one
    virtual FrameCounts counts() const = 0;
    virtual std::string description() const = 0;
    /// True if frames arrive at their own pace. Otherwise they can wait for a slow reader of the spikes.
    virtual bool is_live() const { return true; }
    virtual std::size_t unread_bytes() const { return 0; }                ///< bytes that have arrived but have not been read
    virtual std::optional<FrameError> first_error() const { return {}; }  ///< the first frame that could not be read
    virtual FrameSequence* sequence() { return nullptr; }                 ///< of numbered frames; otherwise null
};

/// `hold` and `max_gap` in frames (see FrameSequence). `batch_frames`: frames that are simulated at once. A header that is refused ends the
/// stream with an error if the source has one sender; otherwise only this sender's frames are ignored.
std::unique_ptr<FrameSource> make_frame_source(std::unique_ptr<ByteSource>, const FrameLayout&, std::int64_t hold, std::int64_t max_gap,
                                               std::size_t batch_frames = 1, HeaderReader = {});

/// A recording. `real_time`: each frame comes at its time; otherwise frames come as fast as they can be simulated.
std::unique_ptr<FrameSource> make_frame_source(std::unique_ptr<ForceSource>, bool real_time);

}  // namespace corpuscle
