#pragma once
// Hands the frames and spikes of a stream to the thread of the page server, without locks and without memory allocation. If the server is
// slow, the ring is full, and frames and spikes are dropped and counted. The stream never waits.

#include "live/frame_observer.hpp"
#include "live/output/event_sink.hpp"

namespace corpuscle {

/// The frames and spikes that the server takes from the ring at once.
struct FrameBatch {
    std::vector<std::int64_t> frames;    ///< numbers of the frames whose forces follow
    std::vector<std::uint32_t> touched;  ///< for each of these frames: number of its sites whose force is not 0
    std::vector<std::uint32_t> sites;    ///< these sites, frame by frame
    std::vector<float> force;            ///< their forces, N
    std::vector<Spike> spikes;           ///< in order of time
    std::int64_t lost_frames = 0;        ///< number of frames that were dropped before these
    std::int64_t lost_spikes = 0;        ///< number of spikes that were dropped before these
    bool empty() const { return frames.empty() && spikes.empty(); }
    void clear();
};

class FrameRing final : public FrameObserver {
    struct Head {
        std::int64_t frame;                     // number of the frame; unused for spikes
        std::uint32_t count;                    // number of touched sites, or of spikes
        std::uint32_t has_force;                // 1: a frame, 0: spikes
        std::int64_t lost_frames, lost_spikes;  // since the previous record
    };
    struct SiteForceValue {
        std::uint32_t site;
        float force;
    };
    static constexpr std::size_t max_spikes = 512;  // per record

    ByteRing ring_;
    std::int64_t frames_per_force_;
    std::atomic<bool> is_watched_ = false;
    std::vector<char> record_;  // scratch memory of the stream's thread
    std::int64_t lost_frames_ = 0, lost_spikes_ = 0;

    bool put(std::int64_t frame, std::uint32_t count, bool has_force, std::size_t value_bytes);
    void read(void* to, std::size_t bytes);

public:
    /// `sites`: of the stream. `rate`: of its frames, Hz. Pages see the forces of each force_interval()-th frame, and all spikes.
    FrameRing(std::size_t sites, double rate, std::size_t min_bytes = std::size_t{4} << 20);

    /// The forces of every n-th frame are passed on; returns n. These are 60 a second or more, unless there are fewer frames.
    static std::int64_t force_interval(std::size_t sites, double rate);
    std::int64_t force_interval() const { return frames_per_force_; }

    void add_frame(std::int64_t frame, std::span<const double> force) override;
    void add_spikes(std::span<const Spike>) override;

    // The rest is for the server's thread.

    /// False, as at the start: no page is connected, and frames are not put into the ring.
    void set_watched(bool is_watched) { is_watched_.store(is_watched, std::memory_order_release); }
    /// Replaces the batch by the records in the ring, or by the first `max_bytes` of them. Returns false if the ring was empty.
    bool take(FrameBatch&, std::size_t max_bytes = std::size_t{1} << 20);
};

}  // namespace corpuscle
