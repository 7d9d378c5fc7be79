#pragma once
// A program of ours that reads one file with a library that damaged files can crash or keep busy for ever. A crash costs an error.

#include <sys/types.h>

#include <string>

#include "io/message.hpp"
#include "signal/error.hpp"

namespace corpuscle {

/// The program holds two descriptors: its end of a socket and the file. It is killed with this object, and when an answer takes too long.
class HelperProcess {
    int socket_ = -1;
    pid_t child_ = -1;
    std::string program_;

    Error failure(const std::string& path, const std::string& library);

public:
    static constexpr unsigned seconds_to_answer = 60;
    static constexpr std::uint64_t memory = std::uint64_t{4} << 30;  ///< bytes, above what the program needs to start
    static constexpr int socket_number = 3, file_number = 4;         ///< the program's descriptors
    static constexpr int other_version = 2;                          ///< exit status of a program that does not know `protocol`
    static constexpr const char* protocol = "reader-1";              ///< the program's only argument

    HelperProcess() = default;
    HelperProcess(HelperProcess&& other) noexcept;
    HelperProcess& operator=(HelperProcess&& other) noexcept;
    ~HelperProcess();

    /// Starts the program at this path with an open file; the caller keeps its own descriptor.
    static Result<HelperProcess> start(const std::string& program, int file, const std::string& argument = protocol);
    pid_t id() const { return child_; }

    void ask(const Message& m) { (void)m.send(socket_); }  // answer() reports a program that is gone
    /// The next message; if there is none, an error about the file. `library` begins its sentence.
    Result<Message> answer(const std::string& path, const std::string& library);
};

/// The path of an installed helper program: in the directory CORPUSCLE_LIBEXEC, if the environment has it; else beside the running program,
/// in ../libexec/corpuscle from there, or in the libexec directory of the prefix that the library was configured with.
Result<std::string> helper_program(const std::string& name);

}  // namespace corpuscle
