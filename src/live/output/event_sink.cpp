// Writes events to pipes and sockets without blocking, in the thread of the stream loop.

#include "live/output/event_sink.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <cerrno>

#include "live/input/byte_source.hpp"

namespace corpuscle {
namespace {

constexpr int check_interval_ms = 100;  // between calls of FinishPolicy::stop()

/// The result of writing: all that is in the ring was written, or less because the reader is slow; or the reader has closed its end, or
/// writing has failed.
enum class WriteResult { all, some, closed };

/// Writes as much of the ring as possible without blocking. `socket`: true if fd is a socket.
WriteResult write_some(ByteRing& ring, int fd, bool socket) {
    for (auto chunk = ring.readable(); !chunk.empty(); chunk = ring.readable()) {
        const auto count =
            socket ? ::send(fd, chunk.data(), chunk.size(), MSG_DONTWAIT | MSG_NOSIGNAL) : ::write(fd, chunk.data(), chunk.size());
        if (count >= 0)
            ring.consume(static_cast<std::size_t>(count));
        else if (errno != EINTR)
            return errno == EAGAIN || errno == EWOULDBLOCK ? WriteResult::some : WriteResult::closed;
    }
    return WriteResult::all;
}

void poll_for_writing(int fd, int ms) {
    pollfd wait = {fd, POLLOUT, 0};
    ::poll(&wait, 1, ms);
}

/// Writes everything in the ring. Gives up if the reader has accepted nothing for the policy's timeout.
WriteResult write_out(ByteRing& ring, int fd, bool socket, const FinishPolicy& policy) {
    for (auto since = steady_now();;) {
        const auto before = ring.total_taken();
        const auto result = write_some(ring, fd, socket);
        if (result != WriteResult::some) return result;
        if (ring.total_taken() != before || (policy.waits_for_stop && !policy.stop())) since = steady_now();
        if (steady_now() - since > policy.timeout) return result;
        poll_for_writing(fd, check_interval_ms);
    }
}

/// A sink that writes without blocking.
class PollingSink : public EventSink {
protected:
    bool waiting_ = false;  // true: data are left because the reader is slow
    virtual int descriptor() const = 0;

public:
    using EventSink::EventSink;
    int poll_fd() const override { return waiting_ ? descriptor() : -1; }
    Result<bool> wait_for_space(std::size_t bytes, int ms) override {
        TRY(flush());
        if (ring_.has_space(bytes)) return true;
        poll_for_writing(descriptor(), ms);
        TRY(flush());
        return ring_.has_space(bytes);
    }
};

class PipeSink final : public PollingSink {
    Descriptor own_;  // closes fd_; empty: fd_ stays open
    int fd_;
    bool socket_;  // true: fd_ is a socket
    std::string name_;

    int descriptor() const override { return fd_; }

    /// Returns an error, and empties the ring, if the reader has closed its end or writing has failed.
    Result<void> check(WriteResult result) {
        waiting_ = result == WriteResult::some;
        if (result != WriteResult::closed) return {};
        const int error_number = errno;
        drop_all();
        return bad_input(error_number == EPIPE || error_number == ECONNRESET
                             ? fmt::format("the reader of {} has closed it", name_)
                             : fmt::format("{} cannot be written: {}", name_, std::strerror(error_number)));
    }

public:
    PipeSink(const EventFormat& format, std::size_t ring, Descriptor own, int fd, bool socket, std::string name)
        : PollingSink(format, ring), own_(std::move(own)), fd_(fd), socket_(socket), name_(std::move(name)) {
        put_header();
    }
    std::string description() const override { return name_; }
    Result<void> flush() override { return check(write_some(ring_, fd_, socket_)); }
    Result<void> finish(const FinishPolicy& policy) override {
        auto done = check(write_out(ring_, fd_, socket_, policy));
        drop_all();
        return done;
    }
};

class NullSink final : public EventSink {
public:
    using EventSink::EventSink;
    std::string description() const override { return "nowhere"; }
    bool is_file() const override { return true; }
    Result<void> flush() override {
        for (auto chunk = ring_.readable(); !chunk.empty(); chunk = ring_.readable()) ring_.consume(chunk.size());
        return {};
    }
    Result<bool> wait_for_space(std::size_t bytes, int) override {
        TRY(flush());
        return ring_.has_space(bytes);
    }
    Result<void> finish(const FinishPolicy&) override { return flush(); }
};

class TcpClientSink final : public PollingSink {
    static constexpr std::int64_t retry_interval = 1'000'000'000;  // ns
    ResolvedEndpoint to_;  // resolved only once: the name service may not be available when the reader reconnects
    Descriptor fd_;
    std::size_t next_address_ = 0;  // index of the address to try next, modulo their number
    bool connected_ = true;
    std::int64_t next_attempt_ = 0;  // steady_now() from which the next connection may be started

    int descriptor() const override { return fd_.get(); }

    void disconnect() {
        fd_.close();
        connected_ = waiting_ = false;
        next_attempt_ = steady_now() + retry_interval;
        drop_all();
    }

    /// Starts a connection, or checks one that was started; never blocks.
    void reconnect() {
        drop_all();
        if (!fd_) {
            if (steady_now() < next_attempt_) return;
            next_attempt_ = steady_now() + retry_interval;
            fd_ = begin_connection(to_.addresses[next_address_++ % to_.addresses.size()]);
            if (!fd_) return;
        }
        const int state = connection_state(fd_);
        if (state < 0) return fd_.close();
        if (state == 0) return;
        disable_send_delay(fd_.get()), enable_keepalive(fd_.get());
        connected_ = true, ++connections_;
        put_header();
    }

public:
    TcpClientSink(const EventFormat& format, std::size_t ring, ResolvedEndpoint to, Descriptor fd)
        : PollingSink(format, ring), to_(std::move(to)), fd_(std::move(fd)) {
        put_header();
    }
    std::string description() const override { return to_.at.text(); }
    Result<void> flush() override {
        if (!connected_) reconnect();
        if (!connected_) return {};
        const auto result = write_some(ring_, fd_.get(), true);
        waiting_ = result == WriteResult::some;
        if (result == WriteResult::closed) disconnect();
        return {};
    }
    Result<void> finish(const FinishPolicy& policy) override {
        if (connected_) write_out(ring_, fd_.get(), true, policy);
        drop_all();
        return {};
    }
};

}  // namespace

void EventSink::drop_all() {
    std::size_t bytes = 0;  // of events, some of which may be incomplete
    for (auto chunk = ring_.readable(); !chunk.empty(); chunk = ring_.readable()) {
        if (const auto at = ring_.total_taken(); at < header_end_) chunk = chunk.substr(0, header_end_ - at);
        if (ring_.total_taken() >= header_end_) {
            bytes += chunk.size();
            if (!format_.has_fixed_size()) dropped_ += std::count(chunk.begin(), chunk.end(), '\n');
        }
        ring_.consume(chunk.size());
    }
    if (format_.has_fixed_size()) dropped_ += static_cast<std::int64_t>((bytes + format_.max_bytes() - 1) / format_.max_bytes());
}

std::unique_ptr<EventSink> make_pipe_sink(Descriptor own, int fd, std::string name, const EventFormat& format, std::size_t ring) {
    struct ::stat info = {};
    const bool socket = ::fstat(fd, &info) == 0 && S_ISSOCK(info.st_mode);
    if (!socket) ::fcntl(fd, F_SETFL, ::fcntl(fd, F_GETFL) | O_NONBLOCK);
    return std::make_unique<PipeSink>(format, ring, std::move(own), fd, socket, std::move(name));
}

std::unique_ptr<EventSink> make_null_sink(const EventFormat& format, std::size_t ring) { return std::make_unique<NullSink>(format, ring); }

Result<std::unique_ptr<EventSink>> open_standard_output(const EventFormat& format, std::size_t ring) {
    struct ::stat info = {};
    if (::fstat(STDOUT_FILENO, &info) != 0) return bad_input("there is no standard output");
    if (S_ISREG(info.st_mode)) return make_file_sink(STDOUT_FILENO, "standard output", format, ring);
    // Opens the same pipe or terminal again. Other processes that share the original descriptor are not affected by its non-blocking mode.
    Descriptor own(S_ISSOCK(info.st_mode) ? -1 : ::open("/proc/self/fd/1", O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
    const int fd = own ? own.get() : STDOUT_FILENO;
    return make_pipe_sink(std::move(own), fd, "standard output", format, ring);
}

Result<std::unique_ptr<EventSink>> connect_event_client(const std::string& endpoint, const EventFormat& format, std::size_t ring) {
    const auto at = TRY(parse_endpoint(endpoint));
    auto to = TRY(resolve(at));
    return connect_event_client(std::move(to), format, ring);
}

Result<std::unique_ptr<EventSink>> connect_event_client(ResolvedEndpoint to, const EventFormat& format, std::size_t ring) {
    auto fd = TRY(connect_socket(to, 5000));
    return std::unique_ptr<EventSink>(std::make_unique<TcpClientSink>(format, ring, std::move(to), std::move(fd)));
}

}  // namespace corpuscle
