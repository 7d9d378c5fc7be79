#include "live/input/byte_source.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <termios.h>
#include <algorithm>
#include <cerrno>
#include <cstring>

#include "live/input/sockets.hpp"

namespace corpuscle {
namespace {

bool is_temporary(int error_number) { return error_number == EAGAIN || error_number == EWOULDBLOCK || error_number == EINTR; }

/// Standard input or a serial device.
class DeviceInput final : public ByteSource {
    Descriptor own_;  // closes fd_; empty: fd_ stays open
    int fd_;
    std::string name_;
    bool can_fail_;  // false: a failure is the end, as of a device that is unplugged

public:
    DeviceInput(Descriptor own, int fd, std::string name, bool can_fail)
        : own_(std::move(own)), fd_(fd), name_(std::move(name)), can_fail_(can_fail) {}
    int poll_fd() const override { return fd_; }
    std::string description() const override { return name_; }
    bool is_live() const override {
        struct ::stat info = {};
        return ::fstat(fd_, &info) != 0 || !S_ISREG(info.st_mode);
    }
    Result<ReadResult> read(std::span<char> out) override {
        const auto count = ::read(fd_, out.data(), out.size());
        if (count > 0) return ReadResult{ReadResult::bytes, static_cast<std::size_t>(count)};
        if (count < 0 && is_temporary(errno)) return ReadResult{ReadResult::nothing};
        if (count == 0 || !can_fail_) return ReadResult{ReadResult::end};
        return bad_input(fmt::format("{} cannot be read: {}", name_, std::strerror(errno)));
    }
};

/// A server for one client at a time.
class Listener final : public ByteSource {
    static constexpr std::int64_t check_interval = 200'000'000;  // ns; once the client is idle, time between checks if another one waits
    Endpoint at_;
    Descriptor listener_, client_;  // client_: empty if no client is connected
    SenderLimits limits_;
    std::int64_t clients_ = 0, idle_clients_ = 0;  // clients so far; those that were replaced because they were idle
    std::int64_t due_ = steady_never;              // steady_now() of the next check_idle()
    int low_watermark_ = 1;                        // bytes

    /// Accepts a client if one waits.
    ReadResult accept() {
        client_ = Descriptor(::accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
        if (!client_) return {ReadResult::nothing};
        ++clients_;
        enable_keepalive(client_.get());
        apply_low_watermark();
        restart_idle_timer();
        return {ReadResult::nothing};  // the next read() reads from the client
    }
    void apply_low_watermark() const { ::setsockopt(client_.get(), SOL_SOCKET, SO_RCVLOWAT, &low_watermark_, sizeof low_watermark_); }
    void restart_idle_timer() {
        if (limits_.idle > 0) due_ = steady_now() + limits_.idle;
    }

    ReadResult disconnect() {
        client_.close();
        due_ = steady_never;
        return {limits_.clients > 0 && clients_ >= limits_.clients ? ReadResult::end : ReadResult::disconnected};
    }

    bool is_another_waiting() const {
        pollfd listener = {listener_.get(), POLLIN, 0};
        return ::poll(&listener, 1, 0) == 1;
    }

    /// Called if the client is connected, but nothing has arrived. Disconnects it if it has been idle for the limit and another client
    /// waits.
    ReadResult check_idle() {
        const auto now = steady_now();
        if (now < due_) return {ReadResult::nothing};
        due_ = now + check_interval;
        if (!is_another_waiting()) return {ReadResult::nothing};
        ++idle_clients_;
        return disconnect();
    }

public:
    Listener(const Endpoint& at, Descriptor listener, const SenderLimits& limits)
        : at_(at), listener_(std::move(listener)), limits_(limits) {}
    int poll_fd() const override { return client_ ? client_.get() : listener_.get(); }
    std::int64_t due_time() const override { return due_; }
    std::string description() const override { return "listening on " + at_.text(); }
    void set_low_watermark(std::size_t bytes) override {
        low_watermark_ = static_cast<int>(std::min<std::size_t>(bytes, 1 << 20));
        if (client_) apply_low_watermark();
    }
    bool has_one_sender() const override { return false; }
    std::int64_t sender_count() const override { return clients_; }
    SenderCounts sender_counts() const override { return {.idle = idle_clients_}; }
    Result<ReadResult> read(std::span<char> out) override {
        if (!client_) return accept();
        const auto count = ::recv(client_.get(), out.data(), out.size(), 0);
        if (count > 0) return restart_idle_timer(), ReadResult{ReadResult::bytes, static_cast<std::size_t>(count)};
        if (count < 0 && is_temporary(errno)) return check_idle();
        return disconnect();  // closed or failed: accept the next client
    }
};

constexpr std::pair<long, speed_t> bauds[] = {{9600, B9600},       {19200, B19200},     {38400, B38400},     {57600, B57600},
                                              {115200, B115200},   {230400, B230400},   {460800, B460800},   {921600, B921600},
                                              {1000000, B1000000}, {2000000, B2000000}, {3000000, B3000000}, {4000000, B4000000}};

constexpr int receive_buffer = 4 << 20;  // requested receive buffer, bytes; the system may grant less

/// A datagram that has been received.
struct Datagram {
    ssize_t bytes = -1;  ///< its size; negative: nothing was received, see errno
    SocketAddress from;
    std::optional<std::uint32_t> total_dropped;  ///< number of datagrams that the system has dropped on this socket so far
};

/// Receives a datagram into `out`, if one has arrived.
Datagram receive_one(int fd, std::span<char> out) {
    Datagram datagram;
    iovec to = {out.data(), out.size()};
    alignas(cmsghdr) char control[CMSG_SPACE(sizeof(std::uint32_t))];
    msghdr message = {};
    message.msg_name = &datagram.from.bytes, message.msg_namelen = sizeof datagram.from.bytes;
    message.msg_iov = &to, message.msg_iovlen = 1;
    message.msg_control = control, message.msg_controllen = sizeof control;
    datagram.bytes = ::recvmsg(fd, &message, 0);
    if (datagram.bytes < 0) return datagram;
    datagram.from.size = message.msg_namelen;
    if (const auto* head = CMSG_FIRSTHDR(&message); head && head->cmsg_level == SOL_SOCKET && head->cmsg_type == SO_RXQ_OVFL) {
        std::uint32_t dropped = 0;
        std::memcpy(&dropped, CMSG_DATA(head), sizeof dropped);
        datagram.total_dropped = dropped;
    }
    return datagram;
}

/// Frames in datagrams: each datagram contains whole frames, from one sender at a time.
class DatagramSource final : public ByteSource {
    Endpoint at_;
    Descriptor fd_;
    SenderLimits limits_;
    std::optional<SocketAddress> sender_;           // the current sender, from its first datagram on
    std::int64_t senders_ = 0, last_received_ = 0;  // senders so far; steady_now() of the current sender's last datagram
    SenderCounts counts_;

    bool is_idle(std::int64_t now) const { return limits_.idle > 0 && now - last_received_ >= limits_.idle; }

    /// Ends the current sender. If it was the last one that SenderLimits::clients allows, the source ends, too.
    ReadResult end_sender() {
        sender_.reset();
        return {limits_.clients > 0 && senders_ >= limits_.clients ? ReadResult::end : ReadResult::disconnected};
    }

    /// Decides about a datagram: uses it, or ignores it because another sender is current.
    ReadResult accept(const Datagram& datagram) {
        const auto now = steady_now();
        bool is_new_sender = false;
        if (!sender_ || !(*sender_ == datagram.from)) {
            if (sender_ && !is_idle(now)) return ++counts_.ignored, ReadResult{ReadResult::nothing};
            if (sender_) {
                ++counts_.idle;
                if (end_sender().status == ReadResult::end) return {ReadResult::end};
            }
            sender_ = datagram.from, ++senders_, is_new_sender = true;
        }
        last_received_ = now;
        if (datagram.bytes == 0) return end_sender();
        return {ReadResult::bytes, static_cast<std::size_t>(datagram.bytes), is_new_sender};
    }

public:
    DatagramSource(Endpoint at, Descriptor fd, const SenderLimits& limits) : at_(std::move(at)), fd_(std::move(fd)), limits_(limits) {
        const int yes = 1;
        ::setsockopt(fd_.get(), SOL_SOCKET, SO_RXQ_OVFL, &yes, sizeof yes);
        ::setsockopt(fd_.get(), SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
    }
    int poll_fd() const override { return fd_.get(); }
    std::string description() const override { return "listening on " + at_.text() + " for datagrams"; }
    bool has_datagrams() const override { return true; }
    bool has_one_sender() const override { return false; }
    std::int64_t sender_count() const override { return senders_; }
    SenderCounts sender_counts() const override { return counts_; }
    Result<ReadResult> read(std::span<char> out) override {
        const auto datagram = receive_one(fd_.get(), out);
        if (datagram.total_dropped) counts_.dropped = *datagram.total_dropped;
        if (datagram.bytes >= 0) return accept(datagram);
        // An error caused by a datagram to an earlier sender, whose port was closed, does not concern the next sender.
        if (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR || errno == ECONNREFUSED) return ReadResult{ReadResult::nothing};
        return bad_input(at_.text() + " cannot be read: " + std::strerror(errno));
    }
};

}  // namespace

Result<std::unique_ptr<ByteSource>> open_standard_input() {
    return std::unique_ptr<ByteSource>(std::make_unique<DeviceInput>(Descriptor(), STDIN_FILENO, "standard input", true));
}

std::size_t ByteSource::unread_bytes() const {
    int bytes = 0;
    return ::ioctl(poll_fd(), FIONREAD, &bytes) == 0 && bytes > 0 ? static_cast<std::size_t>(bytes) : 0;
}

Result<std::unique_ptr<ByteSource>> listen_on(const std::string& address, int port, const SenderLimits& limits) {
    Endpoint at{address, port};
    auto listener = TRY(open_listening_socket(at));
    return std::unique_ptr<ByteSource>(std::make_unique<Listener>(at, std::move(listener), limits));
}

Result<std::unique_ptr<ByteSource>> open_serial(const std::string& path, long baud) {
    speed_t speed = B0;
    std::string known;
    for (const auto& [number, constant] : bauds) {
        if (number == baud) speed = constant;
        known += fmt::format("{}{}", known.empty() ? "" : ", ", number);
    }
    if (speed == B0) return bad_usage(fmt::format("--baud {}: expected one of {}", baud, known));
    Descriptor line(::open(path.c_str(), O_RDONLY | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
    if (!line) return bad_input(fmt::format("cannot be opened: {}", std::strerror(errno)), {path});
    termios settings = {};
    if (::tcgetattr(line.get(), &settings) != 0) return bad_input("this is not a serial device", {path});
    ::cfmakeraw(&settings);
    settings.c_cflag |= CLOCAL | CREAD;
    settings.c_cflag &= ~static_cast<tcflag_t>(CSTOPB | CRTSCTS);
    settings.c_cc[VMIN] = 1, settings.c_cc[VTIME] = 0;
    ::cfsetspeed(&settings, speed);
    if (::tcsetattr(line.get(), TCSANOW, &settings) != 0)
        return bad_input(fmt::format("cannot be set to {} baud: {}", baud, std::strerror(errno)), {path});
    ::tcflush(line.get(), TCIFLUSH);
    const int fd = line.get();
    return std::unique_ptr<ByteSource>(std::make_unique<DeviceInput>(std::move(line), fd, "serial line " + path, false));
}

Result<std::unique_ptr<ByteSource>> receive_datagrams(const std::string& address, int port, const SenderLimits& limits) {
    Endpoint at{address, port};
    auto fd = TRY(open_datagram_socket(at));
    return std::unique_ptr<ByteSource>(std::make_unique<DatagramSource>(at, std::move(fd), limits));
}

}  // namespace corpuscle
