#include "live/network.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <memory>

namespace corpuscle {
namespace {

using Addresses = std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)>;

Result<Addresses> resolved(const Endpoint& at, int flags) {
    addrinfo wanted = {}, *found = nullptr;
    wanted.ai_family = AF_UNSPEC, wanted.ai_socktype = SOCK_STREAM, wanted.ai_flags = flags | AI_NUMERICSERV;
    const int status = ::getaddrinfo(at.address.c_str(), std::to_string(at.port).c_str(), &wanted, &found);
    if (status != 0) return bad_input(fmt::format("{}: {}", at.text(), ::gai_strerror(status)));
    return Addresses(found, &::freeaddrinfo);
}

Error at_endpoint(std::string_view what, const Endpoint& at, int why) {
    return bad_input(fmt::format("{} {}: {}", what, at.text(), std::strerror(why)));
}

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
        return bad_usage(fmt::format("'{}' is no port, nor an address and a port, such as 7000 or 127.0.0.1:7000", text));
    return at;
}

Result<Descriptor> listening_socket(Endpoint& at) {
    const auto found = resolved(at, AI_PASSIVE);
    if (!found) return found.error();
    int why = EADDRNOTAVAIL;
    for (const auto* a = found->get(); a; a = a->ai_next) {
        Descriptor fd(::socket(a->ai_family, a->ai_socktype | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
        const int yes = 1;
        if (fd) ::setsockopt(fd.get(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
        if (fd && ::bind(fd.get(), a->ai_addr, a->ai_addrlen) == 0 && ::listen(fd.get(), 128) == 0) {
            at.port = port_of(fd.get());
            return fd;
        }
        why = errno;
    }
    return at_endpoint("cannot listen on", at, why);
}

Result<Descriptor> connected_socket(const Endpoint& at, int patience_ms) {
    const auto found = resolved(at, 0);
    if (!found) return found.error();
    int why = EADDRNOTAVAIL;
    for (const auto* a = found->get(); a; a = a->ai_next) {
        Descriptor fd(::socket(a->ai_family, a->ai_socktype | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
        if (fd && (::connect(fd.get(), a->ai_addr, a->ai_addrlen) == 0 || errno == EINPROGRESS)) {
            if (patience_ms == 0) return fd;
            pollfd wait = {fd.get(), POLLOUT, 0};
            ::poll(&wait, 1, patience_ms);
            const int state = connection_state(fd);
            if (state > 0) return without_delay(fd.get()), std::move(fd);
            why = state < 0 ? errno : ETIMEDOUT;
        } else {
            why = errno;
        }
    }
    return at_endpoint("cannot connect to", at, why);
}

int connection_state(const Descriptor& fd) {
    pollfd wait = {fd.get(), POLLOUT, 0};
    if (::poll(&wait, 1, 0) == 0) return 0;
    int why = 0;
    socklen_t size = sizeof why;
    if (::getsockopt(fd.get(), SOL_SOCKET, SO_ERROR, &why, &size) != 0 || why != 0) return errno = why, -1;
    return 1;
}

void without_delay(int fd) {
    const int yes = 1;
    ::setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
}

}  // namespace corpuscle
