// Frames in datagrams: each datagram holds whole frames, all from one sender at a time.

#include <sys/socket.h>
#include <cerrno>
#include <cstring>
#include <optional>

#include "live/byte_source.hpp"
#include "live/network.hpp"

namespace corpuscle {
namespace {

constexpr int receive_room = 4 << 20;  // bytes the system is asked to keep for us; it may grant fewer

/// One datagram, as the system hands it out.
struct Datagram {
    ssize_t bytes = -1;
    SocketAddress from;
    std::optional<std::uint32_t> lost;  ///< of all that came to this socket, how many found no room
};

Datagram receive_one(int fd, std::span<char> out) {
    Datagram got;
    iovec to = {out.data(), out.size()};
    alignas(cmsghdr) char control[CMSG_SPACE(sizeof(std::uint32_t))];
    msghdr message = {};
    message.msg_name = &got.from.bytes, message.msg_namelen = sizeof got.from.bytes;
    message.msg_iov = &to, message.msg_iovlen = 1;
    message.msg_control = control, message.msg_controllen = sizeof control;
    got.bytes = ::recvmsg(fd, &message, 0);
    if (got.bytes < 0) return got;
    got.from.size = message.msg_namelen;
    if (const auto* head = CMSG_FIRSTHDR(&message); head && head->cmsg_level == SOL_SOCKET && head->cmsg_type == SO_RXQ_OVFL) {
        std::uint32_t lost = 0;
        std::memcpy(&lost, CMSG_DATA(head), sizeof lost);
        got.lost = lost;
    }
    return got;
}

class DatagramSource final : public ByteSource {
    Endpoint at_;
    Descriptor fd_;
    SenderLimits limits_;
    std::optional<SocketAddress> sender_;
    std::int64_t senders_ = 0, heard_ = 0;
    SenderCounts counts_;

    bool is_idle(std::int64_t now) const { return limits_.idle > 0 && now - heard_ >= limits_.idle; }

    Came ended() {
        sender_.reset();
        return {limits_.clients > 0 && senders_ >= limits_.clients ? Came::end : Came::gone};
    }

    Came taken(const Datagram& got) {
        const auto now = steady_now();
        bool from_another = false;
        if (!sender_ || !(*sender_ == got.from)) {
            if (sender_ && !is_idle(now)) return ++counts_.strangers, Came{Came::nothing};
            if (sender_) {
                ++counts_.idle;
                if (ended().what == Came::end) return {Came::end};
            }
            sender_ = got.from, ++senders_, from_another = true;
        }
        heard_ = now;
        if (got.bytes == 0) return ended();
        return {Came::bytes, static_cast<std::size_t>(got.bytes), from_another};
    }

public:
    DatagramSource(Endpoint at, Descriptor fd, const SenderLimits& limits) : at_(std::move(at)), fd_(std::move(fd)), limits_(limits) {
        const int yes = 1;
        ::setsockopt(fd_.get(), SOL_SOCKET, SO_RXQ_OVFL, &yes, sizeof yes);
        ::setsockopt(fd_.get(), SOL_SOCKET, SO_RCVBUF, &receive_room, sizeof receive_room);
    }
    int waits_on() const override { return fd_.get(); }
    std::string sentence() const override { return "listening on " + at_.text() + " for datagrams"; }
    bool has_datagrams() const override { return true; }
    bool has_one_sender() const override { return false; }
    std::int64_t producers() const override { return senders_; }
    SenderCounts senders() const override { return counts_; }
    Result<Came> read(std::span<char> out) override {
        const auto got = receive_one(fd_.get(), out);
        if (got.lost) counts_.lost = *got.lost;
        if (got.bytes >= 0) return taken(got);
        // An error that a datagram of an earlier sender caused (its port was closed) is no fault of the next.
        if (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR || errno == ECONNREFUSED) return Came{Came::nothing};
        return bad_input(at_.text() + " cannot be read: " + std::strerror(errno));
    }
};

}  // namespace

Result<std::unique_ptr<ByteSource>> receive_datagrams(const std::string& address, int port, const SenderLimits& limits) {
    Endpoint at{address, port};
    auto fd = datagram_socket(at);
    if (!fd) return fd.error();
    return std::unique_ptr<ByteSource>(std::make_unique<DatagramSource>(at, std::move(*fd), limits));
}

}  // namespace corpuscle
