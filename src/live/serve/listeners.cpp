#include "live/serve/listeners.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <ifaddrs.h>
#include <netinet/in.h>
#include <cerrno>
#include <cstring>

namespace corpuscle {
namespace {

constexpr int attempts = 20;  // to find a port that is free on both loopback addresses

bool is_because_of(const Error& error, int error_number) { return error.message.ends_with(std::strerror(error_number)); }

/// Adds the remedy to an error of listening.
Error with_remedy(Error error) {
    if (is_because_of(error, EADDRINUSE))
        error.message += "; another program uses this port: give --serve another number, or 0 for any free port";
    else if (is_because_of(error, EACCES))
        error.message += "; use a port above 1023";
    else
        error.message += "; give --bind an address of this machine ('ip address' lists them), or 0.0.0.0 for all of them";
    return error;
}

std::string url_of(const std::string& address, int port) { return fmt::format("http://{}/", Endpoint{address, port}.text()); }

/// The text of an address that other machines can reach; "" for loopback, link-local and other kinds of address.
std::string text_of(const sockaddr* address) {
    char text[INET6_ADDRSTRLEN] = "";
    if (address && address->sa_family == AF_INET) {
        ::inet_ntop(AF_INET, &reinterpret_cast<const sockaddr_in*>(address)->sin_addr, text, sizeof text);
        return std::string(text).starts_with("127.") ? "" : text;
    }
    if (!address || address->sa_family != AF_INET6) return "";
    ::inet_ntop(AF_INET6, &reinterpret_cast<const sockaddr_in6*>(address)->sin6_addr, text, sizeof text);
    return std::string(text) == "::1" || std::string(text).starts_with("fe80") ? "" : text;
}

/// The addresses of this machine that a page on another one can use.
std::vector<std::string> addresses_of_machine(bool with_ipv6) {
    std::vector<std::string> all;
    ifaddrs* first = nullptr;
    if (::getifaddrs(&first) != 0) return all;
    for (const auto* i = first; i; i = i->ifa_next)
        if (i->ifa_addr && (with_ipv6 || i->ifa_addr->sa_family == AF_INET))
            if (auto text = text_of(i->ifa_addr); !text.empty()) all.push_back(std::move(text));
    ::freeifaddrs(first);
    return all;
}

/// Listens on both loopback addresses at the same port. A machine without IPv6 has only the first.
Result<Listeners> listen_on_loopback(int port) {
    Endpoint first{"127.0.0.1", port};
    Listeners out;
    out.sockets.push_back(TRY(open_listening_socket(first)));
    out.port = first.port;
    out.urls.push_back(url_of("localhost", out.port));
    Endpoint second{"::1", out.port};
    auto opened = open_listening_socket(second);
    if (opened)
        out.sockets.push_back(*std::move(opened));
    else if (is_because_of(opened.error(), EADDRINUSE))  // else localhost would lead some browsers to another program
        return opened.error();
    return out;
}

}  // namespace

Result<Listeners> open_listeners(const std::string& address, int port) {
    if (address.empty()) {
        auto out = listen_on_loopback(port);
        for (int k = 0; !out && port == 0 && k < attempts; ++k) out = listen_on_loopback(port);
        if (!out) return with_remedy(out.error());
        return out;
    }
    Endpoint at{address, port};
    auto opened = open_listening_socket(at);
    if (!opened) return with_remedy(opened.error());
    Listeners out;
    out.sockets.push_back(*std::move(opened));
    out.port = at.port;
    const bool is_any = address == "0.0.0.0" || address == "::";
    for (const auto& a : is_any ? addresses_of_machine(address == "::") : std::vector{address}) out.urls.push_back(url_of(a, at.port));
    if (out.urls.empty()) out.urls.push_back(url_of(address, at.port));
    return out;
}

}  // namespace corpuscle
