#pragma once
// Where a stream's frames come from: bytes by the layout of a frame, or a recording at its own pace.

#include <memory>
#include <optional>
#include <span>

#include "live/byte_source.hpp"
#include "live/frame_layout.hpp"
#include "live/frame_misfit.hpp"
#include "live/frame_order.hpp"
#include "live/header_reader.hpp"
#include "live/steady_clock.hpp"
#include "signal/source.hpp"

namespace corpuscle {

struct FrameCounts {
    std::int64_t frames = 0;      ///< that came and were answered
    std::int64_t unreadable = 0;  ///< frames of which nothing could be read: the last force was held (of numbered ones: a gap)
    std::int64_t values = 0;      ///< forces that are no number or beyond the limit: that site's last was held
    std::int64_t halves = 0;      ///< frames that were begun when their sender went
    std::int64_t half_bytes = 0;  ///< of the last of those, how many bytes had come
    std::int64_t headers = 0;     ///< first lines that were names
    std::int64_t producers = 0;   ///< that sent
    SenderCounts senders = {};    ///< of senders on a network
    OrderCounts order = {};       ///< of frames that are numbered
};

class FrameSource {
public:
    static constexpr std::int64_t never = steady_never;
    enum class Next {
        nothing,  ///< for now
        frame,    ///< one that came
        filled,   ///< one in the place of a frame that is missing or could not be read
    };

    virtual ~FrameSource() = default;
    virtual int waits_on() const { return -1; }         ///< to be polled for reading; -1: it goes by the clock
    virtual std::int64_t due() const { return never; }  ///< when there is more without a poll; steady_now()
    virtual Result<bool> receive() = 0;                 ///< reads what is there; false: nothing more will come
    virtual void hurry() {}                             ///< whatever is there is to be read, however little
    virtual Next next(std::span<double> force) = 0;     ///< the next frame over the last one
    virtual FrameCounts counts() const = 0;
    virtual std::string sentence() const = 0;
    /// Frames come by a clock that waits for nobody. If not, they can wait for a slow reader of the spikes.
    virtual bool is_live() const { return true; }
    virtual std::size_t unread_bytes() const { return 0; }                  ///< that have come and were not read
    virtual std::optional<FrameMisfit> first_misfit() const { return {}; }  ///< the first frame that could not be read
    virtual FrameOrder* order() { return nullptr; }                         ///< of numbered frames
};

/// `hold`, `longest`: of a gap, in frames (see FrameOrder). `together`: so many are answered at once. A header that is refused is an error
/// of the only sender; of one of several, none of its frames is read.
std::unique_ptr<FrameSource> frames_of(std::unique_ptr<ByteSource>, const FrameLayout&, std::int64_t hold, std::int64_t longest,
                                       std::size_t together = 1, HeaderReader = {});

/// A recording, each frame at its time, or as fast as they can be answered.
std::unique_ptr<FrameSource> frames_of(std::unique_ptr<Source>, bool at_its_pace);

}  // namespace corpuscle
