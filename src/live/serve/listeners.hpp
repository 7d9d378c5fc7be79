#pragma once
// The listening sockets of the page server, and the addresses under which its page can be opened.

#include "live/input/sockets.hpp"

namespace corpuscle {

struct Listeners {
    std::vector<Descriptor> sockets;
    int port = 0;
    std::vector<std::string> urls;  ///< "http://127.0.0.1:8080/"; the best first
};

/// Listens on a port (0: any free one) of a local address. "": on 127.0.0.1 and, if this machine has IPv6, on ::1 at the same port.
Result<Listeners> open_listeners(const std::string& address, int port);

}  // namespace corpuscle
