#pragma once
// The main loop of a live stream: waits for frames, simulates each, writes its spikes. It runs in one thread. It waits for a slow reader of
// the spikes only if this reader is the thread that writes a file, or if the frames can wait.

#include <functional>

#include "live/event_sink.hpp"
#include "live/frame_source.hpp"
#include "live/latency_histogram.hpp"
#include "live/skin_stream.hpp"

namespace corpuscle {

/// Statistics of a stream.
struct StreamStats {
    std::int64_t filled = 0;                             ///< frames inserted for missing or unreadable ones
    std::int64_t spikes = 0;                             ///< spikes of the skin
    std::int64_t dropped = 0;                            ///< spikes dropped because the ring was full
    std::int64_t first_received = 0, last_received = 0;  ///< steady_now() of the first and the last received frame
    std::int64_t received = 0;                           ///< frames received
    std::int64_t reads = 0;                              ///< reads that returned whole frames
    std::size_t unread = 0;                              ///< bytes that had arrived when the stream was stopped, but were not read
    LatencyHistogram latency;                            ///< from reading the last byte of a frame to writing its spikes
    LatencyHistogram jitter;                             ///< difference between the interval of two frames and the sampling interval
    double rate() const {                                ///< rate of received frames, Hz; 0 if unknown
        return received > 1 && last_received > first_received
                   ? static_cast<double>(received - 1) * 1e9 / static_cast<double>(last_received - first_received)
                   : 0;
    }
};

class StreamLoop {
public:
    struct StreamOptions {
        std::function<bool()> stop = [] { return false; };  ///< called at least five times a second
        std::function<void()> on_second = [] {};            ///< called once a second
        bool busy_poll = false;                             ///< busy polling: no wake-up delay, but it uses a core
        std::function<void(const FrameError&)> on_frame_error = [](const FrameError&) {
        };  ///< called for the first frame that could not be read
        bool keeps_state = false;  ///< the state is saved: spikes in transit at the end belong to the next stream
    };

    StreamLoop(SkinStream& skin, const EventFormat& format, FrameSource& frames, EventSink& sink, StreamOptions options);

    /// Runs until the frames end, StreamOptions::stop returns true, or the reader of the spikes disconnects.
    Result<void> run();
    const StreamStats& stats() const { return stats_; }
    std::span<double> force() { return force_; }  ///< of the last frame, N

private:
    Result<bool> wait();
    Result<void> run_received();
    Result<void> run_frame(bool was_received, std::int64_t at);
    Result<void> run_batch();
    Result<void> run_remaining();
    Result<void> write_spikes(const Result<std::span<const Spike>>&);
    Result<void> put(std::span<const Spike> spikes);
    Result<bool> wait_for_space(std::size_t bytes);
    bool waits_for_reader() const { return sink_.is_file() || !frames_.is_live(); }
    void record_arrival(std::int64_t at);

    SkinStream& skin_;
    const EventFormat& format_;
    FrameSource& frames_;
    EventSink& sink_;
    StreamOptions options_;
    StreamStats stats_;
    std::vector<double> force_;
    std::vector<char> event_;
    std::vector<std::int64_t> arrival_times_;  // arrival times of the received frames of the batch
    std::int64_t next_check_ = 0, reader_deadline_ = FrameSource::never;
    bool error_reported_ = false;
};

}  // namespace corpuscle
