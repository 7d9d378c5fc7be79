#include "live/input/sockets.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <cerrno>
#include <charconv>
#include <cstring>

namespace corpuscle {
namespace {

using AddressList = std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)>;

/// The addresses of an endpoint for sockets of a type; `flags` of getaddrinfo().
Result<std::vector<SocketAddress>> addresses_of(const Endpoint& at, int socket_type, int flags) {
    addrinfo wanted = {}, *found = nullptr;
    wanted.ai_family = AF_UNSPEC, wanted.ai_socktype = socket_type, wanted.ai_flags = flags | AI_NUMERICSERV;
    const int status = ::getaddrinfo(at.address.c_str(), std::to_string(at.port).c_str(), &wanted, &found);
    if (status != 0) return bad_input(fmt::format("{}: {}", at.text(), ::gai_strerror(status)));
    const AddressList list(found, &::freeaddrinfo);
    std::vector<SocketAddress> all;
    for (const auto* a = list.get(); a; a = a->ai_next) {
        auto& address = all.emplace_back();
        std::memcpy(&address.bytes, a->ai_addr, a->ai_addrlen);
        address.size = a->ai_addrlen;
    }
    return all;
}

const sockaddr* as_sockaddr(const SocketAddress& address) { return reinterpret_cast<const sockaddr*>(&address.bytes); }

/// "cannot connect to 127.0.0.1:7000: Connection refused", from the beginning `what` and an errno.
Error at_endpoint(std::string_view what, const Endpoint& at, int error_number) {
    return bad_input(fmt::format("{} {}: {}", what, at.text(), std::strerror(error_number)));
}

/// The local port of a socket.
int port_of(int fd) {
    sockaddr_storage address = {};
    socklen_t size = sizeof address;
    if (::getsockname(fd, reinterpret_cast<sockaddr*>(&address), &size) != 0) return 0;
    return ntohs(address.ss_family == AF_INET6 ? reinterpret_cast<sockaddr_in6&>(address).sin6_port
                                               : reinterpret_cast<sockaddr_in&>(address).sin_port);
}

}  // namespace

std::string Endpoint::text() const {
    return address.find(':') == address.npos ? fmt::format("{}:{}", address, port) : fmt::format("[{}]:{}", address, port);
}

Result<Endpoint> parse_endpoint(std::string_view text) {
    Endpoint at;
    const auto colon = text.rfind(':');
    auto number = colon == text.npos ? text : text.substr(colon + 1);
    if (colon != text.npos && colon > 0) at.address = text.substr(0, colon);
    if (at.address.size() > 2 && at.address.front() == '[' && at.address.back() == ']')
        at.address = at.address.substr(1, at.address.size() - 2);
    const auto [end, status] = std::from_chars(number.data(), number.data() + number.size(), at.port);
    if (status != std::errc{} || end != number.data() + number.size() || at.port < 0 || at.port > 65535)
        return bad_usage(fmt::format("'{}': expected PORT or ADDRESS:PORT, such as 7000 or 127.0.0.1:7000", text));
    return at;
}

bool SocketAddress::operator==(const SocketAddress& other) const {
    return size == other.size && std::memcmp(&bytes, &other.bytes, size) == 0;
}

Result<ResolvedEndpoint> resolve(const Endpoint& at) {
    auto addresses = TRY(addresses_of(at, SOCK_STREAM, 0));
    return ResolvedEndpoint{at, std::move(addresses)};
}

namespace {

/// Opens a socket at the first usable address of the endpoint, and writes its port there. make_ready(fd, address) configures and binds the
/// socket; it returns false on failure.
template <class MakeReady>
Result<Descriptor> bind_socket(Endpoint& at, int socket_type, const MakeReady& make_ready) {
    const auto addresses = TRY(addresses_of(at, socket_type, AI_PASSIVE));
    int error_number = EADDRNOTAVAIL;
    for (const auto& a : addresses) {
        Descriptor fd(::socket(a.bytes.ss_family, socket_type | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
        if (fd && make_ready(fd.get(), a)) {
            at.port = port_of(fd.get());
            return fd;
        }
        error_number = errno;
    }
    return at_endpoint("cannot listen on", at, error_number);
}

}  // namespace

Result<Descriptor> open_listening_socket(Endpoint& at) {
    return bind_socket(at, SOCK_STREAM, [](int fd, const SocketAddress& a) {
        const int yes = 1;
        ::setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
        return ::bind(fd, as_sockaddr(a), a.size) == 0 && ::listen(fd, 128) == 0;
    });
}

Result<Descriptor> open_datagram_socket(Endpoint& at) {
    return bind_socket(at, SOCK_DGRAM, [](int fd, const SocketAddress& a) { return ::bind(fd, as_sockaddr(a), a.size) == 0; });
}

Descriptor begin_connection(const SocketAddress& to) {
    Descriptor fd(::socket(to.bytes.ss_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
    if (fd && (::connect(fd.get(), as_sockaddr(to), to.size) == 0 || errno == EINPROGRESS)) return fd;
    return {};
}

Result<Descriptor> connect_socket(const ResolvedEndpoint& to, int timeout_ms) {
    int error_number = EADDRNOTAVAIL;
    for (const auto& address : to.addresses) {
        auto fd = begin_connection(address);
        if (!fd) {
            error_number = errno;
            continue;
        }
        pollfd wait = {fd.get(), POLLOUT, 0};
        ::poll(&wait, 1, timeout_ms);
        const int state = connection_state(fd);
        if (state > 0) return disable_send_delay(fd.get()), enable_keepalive(fd.get()), std::move(fd);
        error_number = state < 0 ? errno : ETIMEDOUT;
    }
    return at_endpoint("cannot connect to", to.at, error_number);
}

int connection_state(const Descriptor& fd) {
    pollfd wait = {fd.get(), POLLOUT, 0};
    if (::poll(&wait, 1, 0) == 0) return 0;
    int error_number = 0;
    socklen_t size = sizeof error_number;
    if (::getsockopt(fd.get(), SOL_SOCKET, SO_ERROR, &error_number, &size) != 0) return -1;
    if (error_number != 0) return errno = error_number, -1;
    return 1;
}

void disable_send_delay(int fd) {
    const int yes = 1;
    ::setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
}

void enable_keepalive(int fd) {
    const auto set = [fd](int level, int option, int value) { ::setsockopt(fd, level, option, &value, sizeof value); };
    set(SOL_SOCKET, SO_KEEPALIVE, 1);
    set(IPPROTO_TCP, TCP_KEEPIDLE, 5);   // seconds of silence before the first probe
    set(IPPROTO_TCP, TCP_KEEPINTVL, 3);  // seconds between probes
    set(IPPROTO_TCP, TCP_KEEPCNT, 3);    // probes without a reply before the connection fails
}

}  // namespace corpuscle
