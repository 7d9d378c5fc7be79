#pragma once
// Opens and connects sockets by address and port.

#include <sys/socket.h>
#include <vector>

#include "core/error.hpp"
#include "io/output/descriptor.hpp"

namespace corpuscle {

/// The address and port of a socket.
struct Endpoint {
    std::string address = "127.0.0.1";  ///< a numeric address, or a name that is to be resolved
    int port = 0;
    std::string text() const;  ///< "127.0.0.1:7000"
};

/// Parses "7000", "127.0.0.1:7000", "[::1]:7000", "robot:7000"; the default address is 127.0.0.1.
Result<Endpoint> parse_endpoint(std::string_view text);

/// A resolved address with its port, as the system represents it.
struct SocketAddress {
    sockaddr_storage bytes = {};
    socklen_t size = 0;  ///< number of bytes that are used
    bool operator==(const SocketAddress&) const;
};

/// An endpoint and its resolved addresses, at least one.
struct ResolvedEndpoint {
    Endpoint at;
    std::vector<SocketAddress> addresses;
};
/// Resolves the address of an endpoint, which may take minutes.
Result<ResolvedEndpoint> resolve(const Endpoint&);

/// Opens a listening, non-blocking TCP socket. If the port is 0, a free one is chosen and written to the endpoint.
Result<Descriptor> open_listening_socket(Endpoint&);
/// Opens a non-blocking socket for datagrams; the port as above.
Result<Descriptor> open_datagram_socket(Endpoint&);
/// Connects a non-blocking TCP socket. Tries one address after another, each for at most `timeout_ms`.
Result<Descriptor> connect_socket(const ResolvedEndpoint&, int timeout_ms);
/// Starts a connection and returns at once. Returns an empty descriptor if it failed immediately.
Descriptor begin_connection(const SocketAddress&);
/// State of a connection started by begin_connection(): connected (1), failed (-1, the reason is in errno), or still
/// pending (0).
int connection_state(const Descriptor&);
/// Enables keepalive, so that reads fail within 15 seconds if the machine at the other end or the cable has failed.
void enable_keepalive(int fd);

/// Sends small packets at once (TCP_NODELAY).
void disable_send_delay(int fd);

}  // namespace corpuscle
