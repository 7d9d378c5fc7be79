#pragma once
// Sockets by address and port.

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

/// "7000", "127.0.0.1:7000", "[::1]:7000", "robot:7000"; the address is this machine's own (loopback) if none is said.
Result<Endpoint> parse_endpoint(std::string_view text);

struct SocketAddress {
    sockaddr_storage bytes = {};
    socklen_t size = 0;
    bool operator==(const SocketAddress&) const;
};

/// An endpoint and the addresses that the name service gave for it, at least one. Asking the name service may take minutes.
struct ResolvedEndpoint {
    Endpoint at;
    std::vector<SocketAddress> addresses;
};
Result<ResolvedEndpoint> resolve(const Endpoint&);

/// Without waiting for anybody; the port is filled in if it was 0.
Result<Descriptor> listening_socket(Endpoint&);
/// The same for datagrams.
Result<Descriptor> datagram_socket(Endpoint&);
/// Tries one address after another, each for at most so long, ms; the socket does not block then.
Result<Descriptor> connected_socket(const ResolvedEndpoint&, int patience_ms);
Result<Descriptor> connected_socket(const Endpoint&, int patience_ms);
/// Begins a connection and returns at once; no descriptor: it failed at once.
Descriptor begin_connection(const SocketAddress&);
/// Whether what begin_connection() began has come to a connection (1), to an error (-1), or to nothing yet (0).
int connection_state(const Descriptor&);
/// A silent peer whose machine or cable has died is noticed within 15 seconds: reads then fail.
void watch_peer(int fd);

/// Small pieces go at once.
void without_delay(int fd);

}  // namespace corpuscle
