#pragma once
// Sockets of TCP by address and port.

#include <string>

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

/// Without waiting for anybody; the port is filled in if it was 0.
Result<Descriptor> listening_socket(Endpoint&);
/// Waits at most so long for the other side, ms; the socket does not block then. 0: it is still on its way when this returns.
Result<Descriptor> connected_socket(const Endpoint&, int patience_ms);
/// Whether what connected_socket(..., 0) began has come to a connection (1), to an error (-1), or to nothing yet (0).
int connection_state(const Descriptor&);

/// Small pieces go at once.
void without_delay(int fd);

}  // namespace corpuscle
