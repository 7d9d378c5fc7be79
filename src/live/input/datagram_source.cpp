// Frames in datagrams: each datagram contains whole frames, from one sender at a time.

#include <sys/socket.h>
#include <cerrno>
#include <cstring>
#include <optional>

#include "live/input/byte_source.hpp"
#include "live/input/sockets.hpp"

namespace corpuscle {
namespace {

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

Result<std::unique_ptr<ByteSource>> receive_datagrams(const std::string& address, int port, const SenderLimits& limits) {
    Endpoint at{address, port};
    auto fd = TRY(open_datagram_socket(at));
    return std::unique_ptr<ByteSource>(std::make_unique<DatagramSource>(at, std::move(fd), limits));
}

}  // namespace corpuscle
