#pragma once
// A client of the page server that writes HTTP and WebSocket bytes by hand, also wrong ones. Included only by the tests of the server.

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <fmt/format.h>
#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "live/input/sockets.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

/// A WebSocket frame of the server. `opcode`: 2 binary, 8 close, 9 ping, 10 pong.
struct ServerFrame {
    int opcode = 0;
    std::string data;
    /// The status of a close frame.
    int close_code() const { return data.size() < 2 ? 0 : static_cast<unsigned char>(data[0]) << 8 | static_cast<unsigned char>(data[1]); }
};

/// The head of a message of the server, in the format of the page.
nlohmann::json head_of(const std::string& message) {
    std::uint32_t length = 0;
    if (message.size() < 4) return {};
    std::memcpy(&length, message.data(), 4);
    return nlohmann::json::parse(message.substr(4, length), nullptr, false);
}

/// A frame of a client: masked, as it must be. `first`: the first byte, with the bit of the last fragment (0x80) and the opcode.
std::string client_frame(int first, std::string_view data, bool is_masked = true) {
    std::string out(1, static_cast<char>(first));
    const auto mask_bit = is_masked ? 0x80U : 0U;
    if (data.size() < 126) {
        out += static_cast<char>(mask_bit | data.size());
    } else {  // in as few bytes as possible, else the frame itself violates the protocol
        const int bytes = data.size() < 65536 ? 2 : 8;
        out += static_cast<char>(mask_bit | (bytes == 2 ? 126 : 127));
        for (int k = bytes - 1; k >= 0; --k) out += static_cast<char>(data.size() >> (8 * k));
    }
    constexpr std::string_view mask = "\x11\x22\x33\x44";
    if (is_masked) out += mask;
    for (std::size_t k = 0; k < data.size(); ++k) out += is_masked ? static_cast<char>(data[k] ^ mask[k % 4]) : data[k];
    return out;
}

class PageClient {
    Descriptor socket_;
    std::string in_;  // received, not yet used
    int port_;

    /// Receives more bytes; false: the server has closed the connection, or sent nothing for 10 s.
    bool receive() {
        pollfd wait = {socket_.get(), POLLIN, 0};
        if (::poll(&wait, 1, 10000) != 1) return false;
        char chunk[65536];
        const auto count = ::recv(socket_.get(), chunk, sizeof chunk, 0);
        if (count <= 0) return false;
        in_.append(chunk, static_cast<std::size_t>(count));
        return true;
    }
    bool receive_at_least(std::size_t bytes) {
        while (in_.size() < bytes)
            if (!receive()) return false;
        return true;
    }

public:
    explicit PageClient(int port, const std::string& address = "127.0.0.1", int receive_buffer = 0) : port_(port) {
        socket_ = test::value_or_throw(connect_socket(test::value_or_throw(resolve({address, port})), 5000));
        if (receive_buffer > 0) ::setsockopt(socket_.get(), SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
    }
    void send(std::string_view bytes) {
        while (!bytes.empty()) {
            const auto count = ::send(socket_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
            if (count <= 0) {
                pollfd wait = {socket_.get(), POLLOUT, 0};
                if (errno != EAGAIN || ::poll(&wait, 1, 10000) != 1) return;
                continue;
            }
            bytes.remove_prefix(static_cast<std::size_t>(count));
        }
    }
    std::string host() const { return fmt::format("127.0.0.1:{}", port_); }

    /// Sends a request and returns all that the server sends until it closes the connection.
    std::string request(std::string_view text) {
        send(text);
        while (receive()) {
        }
        return std::move(in_);
    }
    /// GET with the right Host header.
    std::string get(const std::string& target, const std::string& more_headers = "", const std::string& method = "GET") {
        return request(fmt::format("{} {} HTTP/1.1\r\nHost: {}\r\n{}\r\n", method, target, host(), more_headers));
    }
    /// Opens the WebSocket. Returns the status of the response.
    int open(const std::string& more_headers = "", const std::string& target = "/stream") {
        send(
            fmt::format("GET {} HTTP/1.1\r\nHost: {}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                        "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n{}\r\n",
                        target, host(), more_headers));
        while (in_.find("\r\n\r\n") == in_.npos)
            if (!receive()) return 0;
        const int status = std::stoi(in_.substr(9, 3));
        if (status == 101) {
            EXPECT_NE(in_.find("s3pPLMBiTxaQ9kYGzzhZRbK+xOo="), in_.npos) << "the reply to this key, from RFC 6455";
            in_.erase(0, in_.find("\r\n\r\n") + 4);
        }
        return status;
    }
    /// The next frame; nullopt if the server has closed the connection.
    std::optional<ServerFrame> next() {
        if (!receive_at_least(2)) return {};
        std::size_t size = static_cast<unsigned char>(in_[1]), head = 2;
        if (size >= 126) {
            const std::size_t bytes = size == 126 ? 2 : 8;
            if (!receive_at_least(2 + bytes)) return {};
            size = 0;
            for (std::size_t k = 0; k < bytes; ++k) size = size << 8 | static_cast<unsigned char>(in_[2 + k]);
            head += bytes;
        }
        if (!receive_at_least(head + size)) return {};
        ServerFrame frame{in_[0] & 15, in_.substr(head, size)};
        in_.erase(0, head + size);
        return frame;
    }
    /// The status of the next close frame; other frames before it are skipped. 0: there is none.
    int close_code() {
        for (auto frame = next(); frame; frame = next())
            if (frame->opcode == 8) return frame->close_code();
        return 0;
    }
};

}  // namespace
}  // namespace corpuscle
