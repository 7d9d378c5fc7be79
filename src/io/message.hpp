#pragma once
// Numbers and texts in a row, on their way through a socket or to another rank.

#include <cstdint>
#include <string>

namespace corpuscle {

/// Values are read in the order in which they were put.
class Message {
    std::string bytes_;
    std::size_t at_ = 0;

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
    /// False if less is left.
    bool get(void* data, std::size_t size);
    bool get(std::uint64_t& n) { return get(&n, sizeof n); }
    bool get(std::string& s);

    bool send(int socket) const;
    /// False if the other end is closed, or silent for longer than the socket's timeout (errno is EAGAIN then).
    bool receive(int socket);
};

}  // namespace corpuscle
