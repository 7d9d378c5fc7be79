#pragma once
// A message to another process over a socket: the size of its bytes, then the bytes (core/bytes.hpp).

#include <string>

namespace corpuscle {

class Message {
    std::string bytes_;

public:
    Message() = default;
    explicit Message(std::string bytes) : bytes_(std::move(bytes)) {}
    const std::string& bytes() const { return bytes_; }
    /// Sends the size and the bytes of the message. Returns false on failure.
    bool send(int socket) const;
    /// Replaces this message by the next one from the socket. Returns false if the other end is closed, sends nothing within the socket's
    /// timeout (errno is then EAGAIN), or states a size that is too large.
    bool receive(int socket);
};

}  // namespace corpuscle
