// Events to standard output and to a socket, written by the loop itself: no write waits.

#include "live/event_outlet.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <algorithm>
#include <cerrno>
#include <cstring>

#include "live/file_outlet.hpp"
#include "live/steady_clock.hpp"

namespace corpuscle {
namespace {

constexpr int between_looks_ms = 100;

enum class Wrote { all, some, gone };

Wrote write_some(ByteRing& ring, int fd, bool socket) {
    for (auto piece = ring.next(); !piece.empty(); piece = ring.next()) {
        const auto count =
            socket ? ::send(fd, piece.data(), piece.size(), MSG_DONTWAIT | MSG_NOSIGNAL) : ::write(fd, piece.data(), piece.size());
        if (count >= 0)
            ring.took(static_cast<std::size_t>(count));
        else if (errno != EINTR)
            return errno == EAGAIN || errno == EWOULDBLOCK ? Wrote::some : Wrote::gone;
    }
    return Wrote::all;
}

void wait_to_write(int fd, int ms) {
    pollfd wait = {fd, POLLOUT, 0};
    ::poll(&wait, 1, ms);
}

/// To the end, as long as something is taken soon enough.
Wrote write_out(ByteRing& ring, int fd, bool socket, const EventPatience& how_long) {
    for (auto since = steady_now();;) {
        const auto before = ring.all_taken();
        const auto wrote = write_some(ring, fd, socket);
        if (wrote != Wrote::some) return wrote;
        if (ring.all_taken() != before || (how_long.is_endless && !how_long.stop())) since = steady_now();
        if (steady_now() - since > how_long.longest) return wrote;
        wait_to_write(fd, between_looks_ms);
    }
}

class PipeOutlet final : public EventOutlet {
    Descriptor own_;
    int fd_;
    bool socket_, waiting_ = false;
    std::string name_;

    Result<void> seen(Wrote wrote) {
        waiting_ = wrote == Wrote::some;
        if (wrote != Wrote::gone) return {};
        const int why = errno;
        lose_all();
        return bad_input(why == EPIPE || why == ECONNRESET ? fmt::format("nobody reads {} any more", name_)
                                                           : fmt::format("{} cannot be written: {}", name_, std::strerror(why)));
    }

public:
    PipeOutlet(const EventFormat& format, std::size_t ring, Descriptor own, int fd, bool socket, std::string name)
        : EventOutlet(format, ring), own_(std::move(own)), fd_(fd), socket_(socket), name_(std::move(name)) {
        put_header();
    }
    std::string sentence() const override { return name_; }
    int waits_on() const override { return waiting_ ? fd_ : -1; }
    Result<void> flush() override { return seen(write_some(ring_, fd_, socket_)); }
    Result<bool> wait_for_room(std::size_t bytes, int ms) override {
        if (auto ok = flush(); !ok) return ok.error();
        if (ring_.has_room(bytes)) return true;
        wait_to_write(fd_, ms);
        if (auto ok = flush(); !ok) return ok.error();
        return ring_.has_room(bytes);
    }
    Result<void> finish(const EventPatience& how_long) override {
        auto done = seen(write_out(ring_, fd_, socket_, how_long));
        lose_all();
        return done;
    }
};

class ClientOutlet final : public EventOutlet {
    static constexpr std::int64_t between_tries = 1'000'000'000;  // ns
    ResolvedEndpoint to_;  // asked of the name service once: it may be gone when the reader comes back
    Descriptor fd_;
    std::size_t next_address_ = 0;
    bool connected_ = true, waiting_ = false;
    std::int64_t next_try_ = 0;

    void leave() {
        fd_.close();
        connected_ = waiting_ = false;
        next_try_ = steady_now() + between_tries;
        lose_all();
    }

    /// Begins a connection, or looks how one that was begun does; never waits.
    void try_again() {
        lose_all();
        if (!fd_) {
            if (steady_now() < next_try_) return;
            next_try_ = steady_now() + between_tries;
            fd_ = begin_connection(to_.addresses[next_address_++ % to_.addresses.size()]);
            if (!fd_) return;
        }
        const int state = connection_state(fd_);
        if (state < 0) return fd_.close();
        if (state == 0) return;
        without_delay(fd_.get()), watch_peer(fd_.get());
        connected_ = true, ++readers_;
        put_header();
    }

public:
    ClientOutlet(const EventFormat& format, std::size_t ring, ResolvedEndpoint to, Descriptor fd)
        : EventOutlet(format, ring), to_(std::move(to)), fd_(std::move(fd)) {
        put_header();
    }
    std::string sentence() const override { return to_.at.text(); }
    int waits_on() const override { return waiting_ ? fd_.get() : -1; }
    Result<void> flush() override {
        if (!connected_) try_again();
        if (!connected_) return {};
        const auto wrote = write_some(ring_, fd_.get(), true);
        waiting_ = wrote == Wrote::some;
        if (wrote == Wrote::gone) leave();
        return {};
    }
    Result<bool> wait_for_room(std::size_t bytes, int ms) override {
        (void)flush();
        if (ring_.has_room(bytes)) return true;
        wait_to_write(fd_.get(), ms);
        (void)flush();
        return ring_.has_room(bytes);
    }
    Result<void> finish(const EventPatience& how_long) override {
        if (connected_) write_out(ring_, fd_.get(), true, how_long);
        lose_all();
        return {};
    }
};

}  // namespace

void EventOutlet::lose_all() {
    std::size_t bytes = 0;
    for (auto piece = ring_.next(); !piece.empty(); piece = ring_.next()) {
        if (const auto at = ring_.all_taken(); at < header_end_) piece = piece.substr(0, header_end_ - at);
        if (ring_.all_taken() >= header_end_) {
            bytes += piece.size();
            if (!format_.same_size()) lost_ += std::count(piece.begin(), piece.end(), '\n');
        }
        ring_.took(piece.size());
    }
    if (format_.same_size()) lost_ += static_cast<std::int64_t>((bytes + format_.most_bytes() - 1) / format_.most_bytes());
}

std::unique_ptr<EventOutlet> pipe_outlet(Descriptor own, int fd, std::string name, const EventFormat& format, std::size_t ring) {
    struct ::stat facts = {};
    const bool socket = ::fstat(fd, &facts) == 0 && S_ISSOCK(facts.st_mode);
    if (!socket) ::fcntl(fd, F_SETFL, ::fcntl(fd, F_GETFL) | O_NONBLOCK);
    return std::make_unique<PipeOutlet>(format, ring, std::move(own), fd, socket, std::move(name));
}

Result<std::unique_ptr<EventOutlet>> standard_output(const EventFormat& format, std::size_t ring) {
    struct ::stat facts = {};
    if (::fstat(STDOUT_FILENO, &facts) != 0) return bad_input("there is no standard output");
    if (S_ISREG(facts.st_mode)) return plain_file_outlet(STDOUT_FILENO, "standard output", format, ring);
    // A way of our own to the same pipe or terminal: set not to wait, it leaves others that share it as they are.
    Descriptor own(S_ISSOCK(facts.st_mode) ? -1 : ::open("/proc/self/fd/1", O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
    const int fd = own ? own.get() : STDOUT_FILENO;
    return pipe_outlet(std::move(own), fd, "standard output", format, ring);
}

Result<std::unique_ptr<EventOutlet>> event_client(const std::string& endpoint, const EventFormat& format, std::size_t ring) {
    const auto at = parse_endpoint(endpoint);
    if (!at) return at.error();
    auto to = resolve(*at);
    if (!to) return to.error();
    return event_client(std::move(*to), format, ring);
}

Result<std::unique_ptr<EventOutlet>> event_client(ResolvedEndpoint to, const EventFormat& format, std::size_t ring) {
    auto fd = connected_socket(to, 5000);
    if (!fd) return fd.error();
    return std::unique_ptr<EventOutlet>(std::make_unique<ClientOutlet>(format, ring, std::move(to), std::move(*fd)));
}

}  // namespace corpuscle
