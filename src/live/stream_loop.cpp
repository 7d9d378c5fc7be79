#include "live/stream_loop.hpp"

#include <poll.h>
#include <cmath>
#include <utility>

namespace corpuscle {
namespace {

constexpr std::int64_t second = 1'000'000'000, max_wait = second / 5;
constexpr std::int64_t max_rest = 5 * second;  // once stopped: for the frames that have come
constexpr int grace_ms = 50;                   // after a stop: total wait for bytes in transit between two machines

}  // namespace

StreamLoop::StreamLoop(SkinStream& skin, const EventFormat& format, FrameSource& frames, EventOutlet& outlet, Ways ways)
    : skin_(skin), format_(format), frames_(frames), outlet_(outlet), ways_(std::move(ways)), force_(skin.sites()),
      event_(format.max_bytes()) {
    came_.reserve(skin.together());
}

Result<void> StreamLoop::run() {
    Result<void> ended;
    while (ended && !ways_.stop()) {
        const auto more = wait();
        if (!more) {
            ended = more.error();
        } else if (!*more) {
            break;
        }
        if (const auto now = steady_now(); now >= next_look_) {
            if (next_look_ > 0) ways_.seen();
            next_look_ = now + second;
        }
    }
    if (ended && ways_.stop()) ended = answer_rest();
    if (ended) ended = answer_gathered();
    if (ended && !ways_.goes_on) ended = put(skin_.last());
    const auto finished = outlet_.finish({patience_ends_ == FrameSource::never ? second : 0, !frames_.is_live(), ways_.stop});
    return ended ? finished : ended;
}

/// Waits for frames, for space to write, or for the next check; returns false at the end of the frames.
Result<bool> StreamLoop::wait() {
    pollfd on[2] = {{frames_.waits_on(), POLLIN, 0}, {outlet_.waits_on(), POLLOUT, 0}};
    const auto left =
        std::max<std::int64_t>(0, std::min(frames_.due() - (frames_.due() == FrameSource::never ? 0 : steady_now()), max_wait));
    const timespec wait = {0, ways_.spin ? 0 : static_cast<long>(left)};
    const int ready = ::ppoll(on, 2, &wait, nullptr);
    if (ready < 0) return true;  // a signal; stop() is checked next
    const bool due = on[0].revents != 0 || frames_.due() <= steady_now();
    if (on[1].revents != 0 || (ready == 0 && !ways_.spin))
        if (auto ok = outlet_.flush(); !ok) return ok.error();
    if (!due) return true;
    const auto more = frames_.receive();
    if (!more && ways_.stop()) return false;  // a read interrupted by a signal
    if (!more) return more.error();
    if (auto ok = answer_all(); !ok) return ok.error();
    return *more;
}

/// After a stop: simulates the frames that have arrived, and waits only briefly for others. The frames of a file can be read again.
Result<void> StreamLoop::answer_rest() {
    frames_.hurry();
    const auto until = steady_now() + max_rest;
    auto grace = second / 1000 * grace_ms;
    for (bool more = frames_.waits_on() >= 0 && frames_.is_live(); more && steady_now() < until;) {
        const auto before = steady_now();
        pollfd on = {frames_.waits_on(), POLLIN, 0};
        const int ready = ::poll(&on, 1, static_cast<int>(std::max<std::int64_t>(0, grace * 1000 / second)));
        grace -= steady_now() - before;
        if (ready == 0) break;
        if (ready < 0) continue;  // a signal
        const auto received = frames_.receive();
        if (!received) return received.error();
        if (auto ok = answer_all(); !ok) return ok;
        more = *received;
    }
    done_.unread = frames_.unread_bytes();
    return {};
}

/// Simulates the frames that have arrived.
Result<void> StreamLoop::answer_all() {
    const auto at = steady_now();
    const auto before = done_.came;
    for (auto next = frames_.next(force_); next != FrameSource::Next::nothing; next = frames_.next(force_))
        if (auto ok = answer(next == FrameSource::Next::frame, at); !ok) return ok;
    done_.reads += done_.came > before;
    if (misfit_told_) return {};
    if (const auto misfit = frames_.first_misfit()) ways_.misfit(*misfit), misfit_told_ = true;
    return {};
}

Result<void> StreamLoop::answer(bool came, std::int64_t at) {
    if (came) {
        frame_came(at);
        came_.push_back(at);
    } else {
        ++done_.filled;
    }
    if (skin_.together() > 1 && !skin_.gather(force_)) return {};
    return tell(skin_.together() > 1 ? skin_.answer_gathered() : skin_.push(force_));
}

/// Simulates an incomplete batch, at the end.
Result<void> StreamLoop::answer_gathered() { return skin_.together() > 1 ? tell(skin_.answer_gathered()) : Result<void>{}; }

Result<void> StreamLoop::tell(const Result<std::span<const Spike>>& spikes) {
    if (!spikes) return spikes.error();
    if (auto ok = put(*spikes); !ok) return ok;
    if (!spikes->empty())
        if (auto ok = outlet_.flush(); !ok) return ok;
    const auto now = steady_now();
    for (const auto at : came_) done_.delay.add(now - at);
    came_.clear();
    return {};
}

Result<void> StreamLoop::put(std::span<const Spike> spikes) {
    done_.spikes += static_cast<std::int64_t>(spikes.size());
    for (const auto& s : spikes) {
        const std::string_view event(event_.data(), format_.write(s, event_.data()));
        if (outlet_.take(event)) continue;
        const auto room = make_room(event.size());
        if (!room) return room.error();
        if (!*room || !outlet_.take(event)) ++done_.dropped;
    }
    return {};
}

/// Waits for space if the reader may be waited for; false: there is none. After a stop, a reader that reads nothing has one more second.
Result<bool> StreamLoop::make_room(std::size_t bytes) {
    while (waits_for_reader() && steady_now() < patience_ends_) {
        const auto room = outlet_.wait_for_room(bytes, 100);
        if (!room || *room) return room;
        if (!outlet_.is_file() && ways_.stop() && patience_ends_ == FrameSource::never) patience_ends_ = steady_now() + second;
    }
    return false;
}

void StreamLoop::frame_came(std::int64_t at) {
    if (done_.came > 0) done_.jitter.add(std::abs(at - done_.last_came - static_cast<std::int64_t>(skin_.clock().T() * 1e9)));
    if (done_.came++ == 0) done_.first_came = at;
    done_.last_came = at;
}

}  // namespace corpuscle
