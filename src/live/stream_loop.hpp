#pragma once
// The main loop of a live stream: waits for frames, simulates each, writes its spikes. It runs in one thread. It waits for a reader of the
// spikes only if this is our own file writer, or if the frames can wait.

#include <functional>

#include "live/delays.hpp"
#include "live/event_outlet.hpp"
#include "live/frame_source.hpp"
#include "live/skin_stream.hpp"

namespace corpuscle {

/// Statistics of a stream.
struct StreamDone {
    std::int64_t filled = 0;                     ///< frames inserted for missing or unreadable ones
    std::int64_t spikes = 0;                     ///< of the skin
    std::int64_t dropped = 0;                    ///< of these, dropped because the ring was full
    std::int64_t first_came = 0, last_came = 0;  ///< frames; steady_now()
    std::int64_t came = 0;                       ///< frames received
    std::int64_t reads = 0;                      ///< reads that returned whole frames
    std::size_t unread = 0;                      ///< bytes that had arrived when it was stopped, but were not read
    Delays delay;                                ///< from reading the last byte of a frame to writing its spikes
    Delays jitter;                               ///< difference between the interval of two frames and the sampling interval
    double rate() const {                        ///< rate of received frames, Hz; 0 if unknown
        return came > 1 && last_came > first_came ? static_cast<double>(came - 1) * 1e9 / static_cast<double>(last_came - first_came) : 0;
    }
};

class StreamLoop {
public:
    struct Ways {
        std::function<bool()> stop = [] { return false; };                           ///< called at least five times a second
        std::function<void()> seen = [] {};                                          ///< called once a second
        bool spin = false;                                                           ///< busy polling: no wake-up delay, but it uses a core
        std::function<void(const FrameMisfit&)> misfit = [](const FrameMisfit&) {};  ///< called for the first frame that could not be read
        bool goes_on = false;  ///< the state is saved: spikes in transit at the end belong to the next stream
    };

    StreamLoop(SkinStream& skin, const EventFormat& format, FrameSource& frames, EventOutlet& outlet, Ways ways);

    /// Runs until the frames end, it is stopped, or the reader of the spikes closes.
    Result<void> run();
    const StreamDone& done() const { return done_; }
    std::span<double> force() { return force_; }  ///< of the last frame, N

private:
    Result<bool> wait();
    Result<void> answer_all();
    Result<void> answer(bool came, std::int64_t at);
    Result<void> answer_gathered();
    Result<void> answer_rest();
    Result<void> tell(const Result<std::span<const Spike>>&);
    Result<void> put(std::span<const Spike> spikes);
    Result<bool> make_room(std::size_t bytes);
    bool waits_for_reader() const { return outlet_.is_file() || !frames_.is_live(); }
    void frame_came(std::int64_t at);

    SkinStream& skin_;
    const EventFormat& format_;
    FrameSource& frames_;
    EventOutlet& outlet_;
    Ways ways_;
    StreamDone done_;
    std::vector<double> force_;
    std::vector<char> event_;
    std::vector<std::int64_t> came_;  // arrival times of the received frames of the batch
    std::int64_t next_look_ = 0, patience_ends_ = FrameSource::never;
    bool misfit_told_ = false;
};

}  // namespace corpuscle
