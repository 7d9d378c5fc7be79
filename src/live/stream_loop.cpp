#include "live/stream_loop.hpp"

#include <poll.h>

namespace corpuscle {
namespace {

constexpr std::int64_t second = 1'000'000'000, max_wait = second / 5;  // ns; max_wait: longest time between two calls of stop()
constexpr std::int64_t max_remaining = 5 * second;  // ns; after a stop: longest time for simulating the frames that have arrived
constexpr int grace_ms = 50;                        // after a stop: total wait for bytes in transit between two machines

}  // namespace

StreamLoop::StreamLoop(SkinStream& skin, const EventFormat& format, FrameSource& frames, EventSink& sink, StreamOptions options)
    : skin_(skin), format_(format), frames_(frames), sink_(sink), options_(std::move(options)), force_(skin.sites()),
      event_(format.max_bytes()) {
    arrival_times_.reserve(skin.batch_frames());
}

Result<void> StreamLoop::run() {
    Result<void> ended;
    frame_ = skin_.frames();
    while (ended && !options_.stop()) {
        const auto more = wait_and_run();
        if (!more) {
            ended = more.error();
        } else if (!*more) {
            break;
        }
        if (const auto now = steady_now(); now >= next_check_) {
            if (next_check_ > 0) options_.on_second();
            next_check_ = now + second;
        }
    }
    if (ended && options_.stop()) ended = run_remaining();
    if (ended) ended = run_batch();
    if (ended && !options_.keeps_state) ended = finish_spikes();
    // The sink's reader has a second to accept the rest, unless it has already had one.
    const auto finished = sink_.finish({reader_deadline_ == FrameSource::never ? second : 0, !frames_.is_live(), options_.stop});
    return ended ? finished : ended;
}

/// Waits until frames arrive, the sink can be written, or max_wait is over. Simulates the frames that have arrived. Returns false at the
/// end of the frames.
Result<bool> StreamLoop::wait_and_run() {
    pollfd on[2] = {{frames_.poll_fd(), POLLIN, 0}, {sink_.poll_fd(), POLLOUT, 0}};
    // ns until frames are due, limited to [0, max_wait]
    const auto left =
        std::max<std::int64_t>(0, std::min(frames_.due_time() - (frames_.due_time() == FrameSource::never ? 0 : steady_now()), max_wait));
    const timespec wait = {0, options_.busy_poll ? 0 : static_cast<long>(left)};
    const int ready = ::ppoll(on, 2, &wait, nullptr);
    if (ready < 0) return true;  // a signal; stop() is checked next
    const bool due = on[0].revents != 0 || frames_.due_time() <= steady_now();
    if (on[1].revents != 0 || (ready == 0 && !options_.busy_poll)) TRY(sink_.flush());
    if (!due) return true;
    const auto more = frames_.receive();
    if (!more && options_.stop()) return false;  // a signal has interrupted the read
    if (!more) return more.error();
    TRY(run_received());
    return *more;
}

/// After a stop: simulates the frames that have arrived, and waits only briefly for others. This is not done for a file, whose frames can
/// be read again.
Result<void> StreamLoop::run_remaining() {
    frames_.disable_batching();
    const auto until = steady_now() + max_remaining;
    auto grace = second / 1000 * grace_ms;  // ns of waiting that are left
    for (bool more = frames_.poll_fd() >= 0 && frames_.is_live(); more && steady_now() < until;) {
        const auto before = steady_now();
        pollfd on = {frames_.poll_fd(), POLLIN, 0};
        const int ready = ::poll(&on, 1, static_cast<int>(std::max<std::int64_t>(0, grace * 1000 / second)));
        grace -= steady_now() - before;
        if (ready == 0) break;
        if (ready < 0) continue;  // a signal
        const auto received = TRY(frames_.receive());
        TRY(run_received());
        more = received;
    }
    stats_.unread = frames_.unread_bytes();
    return {};
}

/// Simulates the frames that have been read.
Result<void> StreamLoop::run_received() {
    const auto now = steady_now();
    const auto before = stats_.received;
    for (auto next = frames_.next(force_); next != FrameSource::Next::nothing; next = frames_.next(force_))
        TRY(run_frame(next == FrameSource::Next::frame, now));
    stats_.reads += stats_.received > before;
    if (error_reported_) return {};
    if (const auto error = frames_.first_error()) options_.on_frame_error(*error), error_reported_ = true;
    return {};
}

/// Simulates the frame in force_, or adds it to the batch. `now` is its time of arrival; an inserted frame (was_received false) has none.
Result<void> StreamLoop::run_frame(bool was_received, std::int64_t now) {
    if (was_received) {
        record_arrival(now);
        arrival_times_.push_back(now);
    } else {
        ++stats_.filled;
    }
    const auto x = frames_.shear_x(), y = frames_.shear_y();
    if (skin_.batch_frames() == 1)
        TRY(write_spikes(skin_.push(force_, x, y)));
    else if (skin_.add_to_batch(force_, x, y))
        TRY(write_spikes(skin_.run_batch()));
    if (options_.observer) options_.observer->add_frame(frame_, force_);
    ++frame_;
    return {};
}

/// Simulates the incomplete batch at the end of a stream.
Result<void> StreamLoop::run_batch() { return skin_.batch_frames() > 1 ? write_spikes(skin_.run_batch()) : Result<void>{}; }

/// Puts spikes into the sink and writes as much as possible. Records the latency of the frames that they belong to.
Result<void> StreamLoop::write_spikes(const Result<std::span<const Spike>>& spikes) {
    if (!spikes) return spikes.error();
    TRY(put(*spikes));
    if (!spikes->empty()) TRY(sink_.flush());
    const auto now = steady_now();
    for (const auto at : arrival_times_) stats_.latency.add(now - at);
    arrival_times_.clear();
    if (options_.observer) options_.observer->add_spikes(*spikes);
    return {};
}

/// Writes the spikes that are still in transit at the end.
Result<void> StreamLoop::finish_spikes() {
    const auto spikes = skin_.finish();
    if (options_.observer) options_.observer->add_spikes(spikes);
    return put(spikes);
}

/// Puts spikes into the sink; drops those for which there is no space.
Result<void> StreamLoop::put(std::span<const Spike> spikes) {
    stats_.spikes += static_cast<std::int64_t>(spikes.size());
    for (const auto& s : spikes) {
        const std::string_view event(event_.data(), format_.write(s, event_.data()));
        if (sink_.put(event)) continue;
        const auto has_space = TRY(wait_for_space(event.size()));
        if (!has_space || !sink_.put(event)) ++stats_.dropped;
    }
    return {};
}

/// Waits for space in the sink's ring buffer if waits_for_reader() is true. Returns false if there is no space. After a stop, a slow reader
/// has one more second.
Result<bool> StreamLoop::wait_for_space(std::size_t bytes) {
    while (waits_for_reader() && steady_now() < reader_deadline_) {
        const auto has_space = sink_.wait_for_space(bytes, 100);
        if (!has_space || *has_space) return has_space;
        if (!sink_.is_file() && options_.stop() && reader_deadline_ == FrameSource::never) reader_deadline_ = steady_now() + second;
    }
    return false;
}

void StreamLoop::record_arrival(std::int64_t now) {
    if (stats_.received > 0) stats_.jitter.add(std::abs(now - stats_.last_received - static_cast<std::int64_t>(skin_.clock().T() * 1e9)));
    if (stats_.received++ == 0) stats_.first_received = now;
    stats_.last_received = now;
}

}  // namespace corpuscle
