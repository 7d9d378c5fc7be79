#pragma once
// Decides whether a request to the page server is answered: who may see the stream, from where, and with which token. It reads the text of
// the request line and of two headers, and knows nothing of connections.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"

namespace corpuscle {

/// Compares in a time that depends on the lengths only, so that a token cannot be guessed letter by letter.
bool equal_in_constant_time(std::string_view a, std::string_view b);

/// A random token of 128 bits, as 32 hexadecimal digits.
Result<std::string> make_access_token();

/// True for an address of the loopback interface: 127.0.0.0/8, ::1 or "localhost".
bool is_loopback_address(std::string_view address);

/// A request as far as access depends on it. The texts are those of the client.
struct PageRequest {
    std::string_view method, target;        ///< "GET", "/?token=..."
    std::vector<std::string_view> hosts;    ///< values of all Host headers
    std::vector<std::string_view> origins;  ///< values of all Origin headers
    bool is_upgrade = false;                ///< a WebSocket handshake
};

/// The answer to a request: an HTTP status, and one sentence for the user.
struct AccessDecision {
    unsigned status = 200;  ///< 200: send the page, 101: open the WebSocket, otherwise refuse
    std::string reason = {};
};

class AccessPolicy {
    std::string token_;               // "": none is required
    std::string socket_path_;         // of the WebSocket; the page is at "/"
    std::vector<std::string> hosts_;  // accepted values of the Host header; empty: all
    std::string url_;

public:
    /// Without a token, as on loopback: the Host header must name this machine as a loopback address. Otherwise another site, whose name
    /// leads to this machine (DNS rebinding), could read the stream. `url`: the address of the page, for messages. `socket_path`: of the
    /// WebSocket, such as "/stream".
    AccessPolicy(std::string address, int port, std::string token, std::string url, std::string socket_path);
    AccessDecision decide(const PageRequest&) const;
};

}  // namespace corpuscle
