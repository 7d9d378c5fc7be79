#include "io/sandbox/message.hpp"

#include <sys/socket.h>
#include <algorithm>
#include <cerrno>
#include <cstring>

namespace corpuscle {
namespace {

constexpr std::uint64_t max_message = std::uint64_t{1} << 30;  // bytes
constexpr std::size_t chunk_bytes = std::size_t{1} << 20;      // memory is allocated in chunks, in case the stated size is wrong

/// Returns false and sets errno on failure.
bool send_all(int socket, const void* data, std::size_t size) {
    for (const char* at = static_cast<const char*>(data); size > 0;) {
        const auto sent = ::send(socket, at, size, MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR) continue;
        if (sent <= 0) return false;
        at += sent, size -= static_cast<std::size_t>(sent);
    }
    return true;
}

/// Returns false and sets errno on failure; ECONNRESET if the other end is closed.
bool receive_all(int socket, void* data, std::size_t size) {
    for (char* at = static_cast<char*>(data); size > 0;) {
        const auto got = ::recv(socket, at, size, 0);
        if (got < 0 && errno == EINTR) continue;
        if (got == 0) errno = ECONNRESET;
        if (got <= 0) return false;
        at += got, size -= static_cast<std::size_t>(got);
    }
    return true;
}

}  // namespace

bool Message::send(int socket) const {
    const std::uint64_t size = bytes_.size();
    return send_all(socket, &size, sizeof size) && send_all(socket, bytes_.data(), bytes_.size());
}

bool Message::receive(int socket) {
    std::uint64_t size = 0;
    bytes_.clear();
    if (!receive_all(socket, &size, sizeof size) || size > max_message) return false;
    while (bytes_.size() < size) {
        const auto old_size = bytes_.size();
        bytes_.resize(old_size + std::min<std::size_t>(chunk_bytes, size - old_size));
        if (!receive_all(socket, bytes_.data() + old_size, bytes_.size() - old_size)) return false;
    }
    return true;
}

}  // namespace corpuscle
