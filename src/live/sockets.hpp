#pragma once
// Opens and connects sockets by address and port.

#include <sys/socket.h>
#include <string>
#include <vector>

#include "live/descriptor.hpp"
#include "signal/error.hpp"

namespace corpuscle {

struct Endpoint {
    std::string address = "127.0.0.1";
    int port = 0;
    std::string text() const;  ///< "127.0.0.1:7000"
};

/// Parses "7000", "127.0.0.1:7000", "[::1]:7000", "robot:7000"; the default address is 127.0.0.1.
Result<Endpoint> parse_endpoint(std::string_view text);

struct SocketAddress {
    sockaddr_storage bytes = {};
    socklen_t size = 0;
    bool operator==(const SocketAddress&) const;
};

/// An endpoint and its resolved addresses, at least one. Resolving a name may take minutes.
struct ResolvedEndpoint {
    Endpoint at;
    std::vector<SocketAddress> addresses;
};
Result<ResolvedEndpoint> resolve(const Endpoint&);

/// A listening, non-blocking socket; fills in the port if it was 0.
Result<Descriptor> open_listening_socket(Endpoint&);
/// The same for datagrams.
Result<Descriptor> open_datagram_socket(Endpoint&);
/// Tries one address after another, each for at most `timeout_ms`. The socket is non-blocking.
Result<Descriptor> connect_socket(const ResolvedEndpoint&, int timeout_ms);
Result<Descriptor> connect_socket(const Endpoint&, int timeout_ms);
/// Starts a connection and returns at once. Returns an empty descriptor if it failed immediately.
Descriptor begin_connection(const SocketAddress&);
/// State of a connection started by begin_connection(): connected (1), failed (-1), or still pending (0).
int connection_state(const Descriptor&);
/// Enables keepalive, so reads fail within 15 seconds if the peer's machine or cable has failed.
void enable_keepalive(int fd);

/// Sends small packets at once (TCP_NODELAY).
void disable_send_delay(int fd);

}  // namespace corpuscle
