#pragma once
// The main loop of a live stream: waits for frames, simulates each, and writes its spikes. It runs in one thread. If the reader of the
// spikes is slow, the loop waits for it only if the spikes go to a file, or if the frames can wait. Otherwise it drops spikes.

#include "live/frame_observer.hpp"
#include "live/input/frame_source.hpp"
#include "live/latency_histogram.hpp"
#include "live/output/event_sink.hpp"
#include "live/skin_stream.hpp"

namespace corpuscle {

/// Statistics of a stream.
struct StreamStats {
    std::int64_t filled = 0;                             ///< number of frames inserted for missing or unreadable ones
    std::int64_t spikes = 0;                             ///< number of spikes of the skin, whether written or dropped
    std::int64_t dropped = 0;                            ///< number of spikes dropped because the sink's ring buffer was full
    std::int64_t first_received = 0, last_received = 0;  ///< steady_now() of the first and the last received frame
    std::int64_t received = 0;                           ///< number of frames received
    std::int64_t reads = 0;                              ///< number of reads after which there was at least one whole frame
    std::size_t unread = 0;    ///< number of bytes that had arrived when the stream was stopped, but were not read
    LatencyHistogram latency;  ///< time from the read that completed a frame to the writing of its spikes
    LatencyHistogram jitter;   ///< absolute difference between the interval of two received frames and the sampling interval
    double rate() const {      ///< rate of received frames, Hz; 0 if unknown
        return received > 1 && last_received > first_received
                   ? static_cast<double>(received - 1) * 1e9 / static_cast<double>(last_received - first_received)
                   : 0;
    }
};

class StreamLoop {
public:
    struct StreamOptions {
        std::function<bool()> stop = [] { return false; };  ///< true: the stream ends; called at least five times a second
        std::function<void()> on_second = [] {};            ///< called once a second
        bool busy_poll = false;                             ///< true: polls without sleeping, which saves the wake-up delay but uses a core
        std::function<void(const FrameError&)> on_frame_error = [](const FrameError&) {
        };  ///< called for the first frame that could not be read
        FrameObserver* observer = nullptr;  ///< sees all frames and spikes; null: none
        bool keeps_state = false;  ///< true: the state will be saved, so spikes in transit at the end are not written but saved with it
    };

    StreamLoop(SkinStream& skin, const EventFormat& format, FrameSource& frames, EventSink& sink, StreamOptions options);

    /// Runs until the frames end, StreamOptions::stop returns true, or the reader of the spikes disconnects.
    Result<void> run();
    const StreamStats& stats() const { return stats_; }
    std::span<double> force() { return force_; }  ///< force of the last frame, N

private:
    Result<bool> wait_and_run();
    Result<void> run_received();
    Result<void> run_frame(bool was_received, std::int64_t now);
    Result<void> run_batch();
    Result<void> run_remaining();
    Result<void> write_spikes(const Result<std::span<const Spike>>&);
    Result<void> finish_spikes();
    Result<void> put(std::span<const Spike> spikes);
    Result<bool> wait_for_space(std::size_t bytes);
    bool waits_for_reader() const { return sink_.is_file() || !frames_.is_live(); }
    void record_arrival(std::int64_t now);

    SkinStream& skin_;
    const EventFormat& format_;
    FrameSource& frames_;
    EventSink& sink_;
    StreamOptions options_;
    StreamStats stats_;
    std::vector<double> force_;
    std::int64_t frame_ = 0;                             // number of the next frame
    std::vector<char> event_;                            // one event in the output format
    std::vector<std::int64_t> arrival_times_;            // steady_now() of the arrival of each received frame of the batch
    std::int64_t next_check_ = 0;                        // steady_now() of the next call of on_second()
    std::int64_t reader_deadline_ = FrameSource::never;  // steady_now() until which a slow reader is waited for, after a stop
    bool error_reported_ = false;                        // true: on_frame_error() has been called
};

}  // namespace corpuscle
