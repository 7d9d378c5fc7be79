#pragma once
// A child of our own for libraries that damaged files can crash or make run for ever: what breaks is the child, and the file is
// refused. It knows nothing but its end of one socket; it dies with us, and of any question that it does not answer in time.

#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "signal/error.hpp"

namespace corpuscle {

/// Numbers and words in a row, on their way through a socket or to another rank; read in the order in which they were put.
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
    bool receive(int socket);
};

class HelperProcess {
    int socket_ = -1;
    pid_t child_ = -1;

    Error death(const std::string& path, const std::string& library);

public:
    static constexpr unsigned seconds_to_answer = 60;
    static constexpr std::uint64_t memory = std::uint64_t{4} << 30;  // bytes, beside what we have ourselves

    HelperProcess() = default;
    HelperProcess(HelperProcess&& other) noexcept;
    HelperProcess& operator=(HelperProcess&& other) noexcept;
    ~HelperProcess();  ///< ends the child

    /// `work` runs in the child, from question to question, until it returns.
    static Result<HelperProcess> start(const std::function<void(int socket)>& work);
    pid_t id() const { return child_; }

    /// The child's next message; if it dies instead, what that says about the file.
    Result<Message> answer(const std::string& path, const std::string& library);
    void ask(const Message& m) { (void)m.send(socket_); }  // a child that is gone is told of by answer()
};

/// In the child: the next question, and from now on the time for its answer is counted.
bool next_question(int socket, Message&);
/// In the child: the time is no longer counted.
bool give_answer(int socket, const Message&);

}  // namespace corpuscle
