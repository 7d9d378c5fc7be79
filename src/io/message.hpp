#pragma once
// A message of numbers and texts, for a socket or another MPI rank.

#include <cstdint>
#include <string>

namespace corpuscle {

/// Values are read in the order in which they were written.
class Message {
    std::string bytes_;
    std::size_t position_ = 0;

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
    /// Returns false if fewer bytes are left.
    bool get(void* data, std::size_t size);
    bool get(std::uint64_t& n) { return get(&n, sizeof n); }
    bool get(std::string& s);

    bool send(int socket) const;
    /// Returns false if the other end is closed, or sends nothing within the socket's timeout (errno is then EAGAIN).
    bool receive(int socket);
};

}  // namespace corpuscle
