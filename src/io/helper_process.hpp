#pragma once
// A child process that reads one file with a library that may crash or hang on a damaged file. A crash of the child becomes an error.

#include <sys/types.h>

#include <string>

#include "io/message.hpp"
#include "signal/error.hpp"

namespace corpuscle {

/// The child holds two descriptors: its end of a socket and the file. It is killed by the destructor, or when a response takes too long.
class HelperProcess {
    int socket_ = -1;
    pid_t child_ = -1;
    std::string program_;

    Error failure(const std::string& path, const std::string& library);

public:
    static constexpr unsigned response_timeout_s = 60;
    static constexpr std::uint64_t memory_limit = std::uint64_t{4} << 30;  ///< bytes, in addition to the memory needed to start
    static constexpr int socket_descriptor = 3, file_descriptor = 4;       ///< descriptors in the child
    static constexpr int exit_unknown_protocol = 2;                        ///< exit status of a child that does not know `protocol`
    static constexpr const char* protocol = "reader-1";                    ///< the only argument of the child

    HelperProcess() = default;
    HelperProcess(HelperProcess&& other) noexcept;
    HelperProcess& operator=(HelperProcess&& other) noexcept;
    ~HelperProcess();

    /// Starts the program at this path with an open file. The caller keeps its own descriptor.
    static Result<HelperProcess> start(const std::string& program, int file, const std::string& argument = protocol);
    pid_t pid() const { return child_; }

    void send(const Message& m) { (void)m.send(socket_); }  // receive() reports a child that has exited
    /// Receives the next message. If the child crashes or does not respond in time, returns an error for the file `path` that names
    /// `library`.
    Result<Message> receive(const std::string& path, const std::string& library);
};

/// The path of an installed helper program. Searches the directory in the environment variable CORPUSCLE_LIBEXEC if it is set.
/// Otherwise searches the directory of the running program, ../libexec/corpuscle relative to it, and the libexec directory of the
/// install prefix.
Result<std::string> find_helper_program(const std::string& name);

}  // namespace corpuscle
