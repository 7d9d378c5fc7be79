#pragma once
// The loop of a live stream: waits for frames, answers each, writes its spikes. One thread; it waits for a reader of the spikes only where
// that is our own writer of a file, or where the frames can wait.

#include <functional>

#include "live/delays.hpp"
#include "live/event_outlet.hpp"
#include "live/frame_source.hpp"
#include "live/skin_stream.hpp"

namespace corpuscle {

/// What has been done, and how long it took.
struct StreamDone {
    std::int64_t filled = 0;                     ///< frames answered in the place of others
    std::int64_t spikes = 0;                     ///< of the skin
    std::int64_t dropped = 0;                    ///< of those, left out since the ring was full
    std::int64_t first_came = 0, last_came = 0;  ///< frames; steady_now()
    std::int64_t came = 0;                       ///< frames
    std::int64_t reads = 0;                      ///< that brought whole frames
    std::size_t unread = 0;                      ///< bytes that had come when it was stopped, and were not read
    Delays delay;                                ///< from a frame's last byte, read, to its spikes written
    Delays jitter;                               ///< how far the time between two frames was from the sample's
    double rate() const {                        ///< at which frames came, Hz; 0 if nobody can say
        return came > 1 && last_came > first_came ? static_cast<double>(came - 1) * 1e9 / static_cast<double>(last_came - first_came) : 0;
    }
};

class StreamLoop {
public:
    struct Ways {
        std::function<bool()> stop = [] { return false; };  ///< asked at least five times a second
        std::function<void()> seen = [] {};                 ///< called once a second
        bool spin = false;                                  ///< wait without sleeping: a core of its own, and no time to wake
        std::function<void(const FrameMisfit&)> misfit = [](const FrameMisfit&) {};  ///< the first frame that could not be read
        bool goes_on = false;  ///< its state is kept: spikes on their way at the end are the next stream's
    };

    StreamLoop(SkinStream& skin, const EventFormat& format, FrameSource& frames, EventOutlet& outlet, Ways ways);

    /// To the end of the frames, until stopped, or until nobody reads the spikes any more.
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
    std::vector<std::int64_t> came_;  // of the frames gathered, those that came: when
    std::int64_t next_look_ = 0, patience_ends_ = FrameSource::never;
    bool misfit_told_ = false;
};

}  // namespace corpuscle
