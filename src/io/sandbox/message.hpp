#pragma once
// A message of numbers and texts to another process: over a socket, to another MPI rank, or in a file.

#include <cstdint>
#include <string>

namespace corpuscle {

/// put() appends values, get() reads them in the same order. Both processes run on the same kind of machine, so that numbers have the same
/// bytes.
class Message {
    std::string bytes_;
    std::size_t position_ = 0;  // of the next value to read

public:
    Message() = default;
    explicit Message(std::string bytes) : bytes_(std::move(bytes)) {}
    const std::string& bytes() const { return bytes_; }

    void put(const void* data, std::size_t size) { bytes_.append(static_cast<const char*>(data), size); }
    void put(std::uint64_t n) { put(&n, sizeof n); }
    void put(const std::string& s) {
        put(s.size());
        put(s.data(), s.size());
    }
    /// Reads the next value. Returns false if the message has too few bytes left.
    bool get(void* data, std::size_t size);
    bool get(std::uint64_t& n) { return get(&n, sizeof n); }
    bool get(std::string& s);
    bool ended() const { return position_ == bytes_.size(); }  ///< true if all values were read

    /// Sends the size and the bytes of the message. Returns false on failure.
    bool send(int socket) const;
    /// Replaces this message by the next one from the socket. Returns false if the other end is closed, sends nothing within the socket's
    /// timeout (errno is then EAGAIN), or states a size that is too large.
    bool receive(int socket);
};

}  // namespace corpuscle
