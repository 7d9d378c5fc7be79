#pragma once
// Sources of a stream's frames: bytes in a given layout, or a recording.

#include "core/force_source.hpp"
#include "io/quality/filters.hpp"
#include "live/input/byte_source.hpp"
#include "live/input/frame_layout.hpp"
#include "skin/taxel/taxel_frames.hpp"

namespace corpuscle {

/// Statistics of a source since its start.
struct FrameCounts {
    std::int64_t frames = 0;  ///< frames that were received and passed on
    /// Frames that could not be read. Each was replaced by one with the last force or, if frames are numbered, left a gap in the sequence.
    std::int64_t unreadable = 0;
    std::int64_t invalid_values = 0;  ///< values that were NaN or beyond the limit, so that the site kept its last force
    std::int64_t partial_frames = 0;  ///< frames that were incomplete when their sender disconnected
    std::int64_t partial_bytes = 0;   ///< bytes of the last partial frame
    std::int64_t headers = 0;         ///< number of first lines that contained names instead of numbers
    std::int64_t sender_count = 0;    ///< number of senders so far
    SenderCounts senders = {};        ///< if the senders are on a network
    SequenceCounts sequence = {};     ///< if frames are numbered
};

/// Delivers frames one by one: receive() reads what has arrived, then next() is called until it returns `nothing`.
class FrameSource {
public:
    static constexpr std::int64_t never = steady_never;
    /// Result of next().
    enum class Next {
        nothing,  ///< no frame has arrived yet
        frame,    ///< a received frame
        filled,   ///< a frame inserted for a missing or unreadable one
    };

    virtual ~FrameSource() = default;
    virtual int poll_fd() const { return -1; }  ///< descriptor to poll for reading; -1: none, due_time() says when to read
    /// The steady_now() at which receive() must be called even if poll() reports nothing.
    virtual std::int64_t due_time() const { return never; }
    virtual Result<bool> receive() = 0;  ///< reads what has arrived; false: the source has ended
    virtual void disable_batching() {}   ///< poll() then reports bytes as soon as any have arrived, not only a batch of frames
    /// Overwrites `force` (N), which must contain the last frame, with the next frame that has been read, if there is one.
    Next next(std::span<double> force);
    /// For frames with fewer forces than a skin has sites, and for filters as those of a recording: from now on, force k of a frame is
    /// filtered by `filters`, and assigned to site sites[k] of `all_sites`. The force at other sites is not changed. Frames
    /// that are inserted for missing ones are filtered, too.
    void assign_sites(std::vector<std::uint32_t> sites, std::size_t all_sites, const ChannelFilters& filters = {});
    /// For frames of taxels: from now on, force k of a frame is filtered and is force columns[k] of a frame of `taxels`, which gives the
    /// force at the `all_sites` sites.
    void assign_taxels(TaxelFrames taxels, std::vector<std::uint32_t> columns, std::size_t all_sites, const ChannelFilters& filters = {});
    /// The shear at all sites in the last frame along x and y, N; empty without three-axis taxels.
    std::span<const double> shear_x() const { return shear_x_; }
    std::span<const double> shear_y() const { return shear_y_; }
    /// The forces of the last frame, before filters, if taxels have been assigned; otherwise empty.
    std::span<double> taxel_frame() { return taxels_.frame_size() > 0 ? std::span(frame_) : std::span<double>(); }
    virtual FrameCounts counts() const = 0;
    virtual std::string description() const = 0;
    /// True if frames arrive at their own pace. False: they can wait until a slow reader has accepted the spikes.
    virtual bool is_live() const { return true; }
    virtual std::size_t unread_bytes() const { return 0; }                ///< bytes that have arrived but have not been read
    virtual std::optional<FrameError> first_error() const { return {}; }  ///< the first frame that could not be read
    virtual FrameSequence* sequence() { return nullptr; }                 ///< the order of numbered frames; null if frames are not numbered

protected:
    bool is_released_ = false;  // true: the last frame was inserted to have no force

private:
    virtual Next read_frame(std::span<double> force) = 0;  ///< as next(), before sites are assigned

    double filtered(std::size_t k);

    std::vector<std::uint32_t> sites_;     // the site or taxel of each force of a frame; empty: all sites in order, without filters
    std::vector<ChannelFilters> filters_;  // of each force; empty: none
    std::vector<double> frame_;            // the last frame before the filters, N; only if sites_ is not empty
    TaxelFrames taxels_;                   // without taxels: default constructed
    std::vector<double> taxel_force_;      // frame of taxels_, N
    std::vector<double> shear_x_, shear_y_;
};

/// A source that decodes frames from bytes. `hold` and `max_gap` are numbers of frames (see FrameSequence), `batch_frames` is the number of
/// frames that are simulated at once. If the HeaderReader refuses a header, the stream ends with an error if the source has one sender;
/// otherwise only this sender's frames are unreadable.
std::unique_ptr<FrameSource> make_frame_source(std::unique_ptr<ByteSource>, const FrameLayout&, std::int64_t hold, std::int64_t max_gap,
                                               std::size_t batch_frames = 1, HeaderReader = {});

/// A source that reads a recording. If `with_shear`, a frame has three forces for each channel of a source with shear: shear along x, along
/// y, normal force. `real_time` true: each sample becomes a frame at its time, counted from the first read; false: frames
/// come as fast as they can be simulated.
std::unique_ptr<FrameSource> make_frame_source(std::unique_ptr<ForceSource>, bool real_time, bool with_shear = false);

}  // namespace corpuscle
