#pragma once
// A child process that reads one file with a library that may crash or hang if the file is damaged. If the child crashes, the caller
// receives an error and continues.

#include <sys/types.h>

#include "core/error.hpp"
#include "io/output/descriptor.hpp"

namespace corpuscle {

/// Sends a message over a socket: the size of its bytes, then the bytes (core/bytes.hpp). Returns false on failure.
bool send_message(int socket, const std::string& message);
/// Replaces `message` by the next one from the socket. Returns false if the other end is closed, sends nothing within the socket's timeout
/// (errno is then EAGAIN), or states a size that is too large.
bool receive_message(int socket, std::string& message);

/// The child has two open descriptors: its end of a socket, and the file. The destructor kills it, and so does receive() if the child takes
/// longer than response_timeout_s to respond.
class HelperProcess {
    Descriptor socket_;  // our end
    pid_t child_ = -1;
    std::string program_;  // path of the child's program, for messages

    Error failure(const std::string& path, const std::string& library);

public:
    static constexpr unsigned response_timeout_s = 60;                     ///< s, for one response
    static constexpr std::uint64_t memory_limit = std::uint64_t{4} << 30;  ///< bytes that the child may allocate after its start
    static constexpr int socket_descriptor = 3, file_descriptor = 4;       ///< descriptors in the child
    static constexpr int exit_unknown_protocol = 2;  ///< exit status of a child of another version, which does not know `protocol`
    // The service that the child offers, with the version of its messages; the only argument of the child.
    static constexpr const char* protocol = "reader-3";         ///< reads samples (remote_samples.hpp)
    static constexpr const char* units_protocol = "units-1";    ///< reads the units of an NWB file (io/nwb/nwb_messages.hpp)
    static constexpr const char* tree_protocol = "tree-1";      ///< reads all datasets of an HDF5 file (io/hdf5/hdf5_tree.hpp)
    static constexpr const char* trials_protocol = "trials-1";  ///< reads the trials of an NWB file (io/nwb/nwb_messages.hpp)
    static constexpr const char* writer_protocol = "writer-1";  ///< writes an HDF5 file (io/hdf5/hdf5_writer.hpp)

    HelperProcess() = default;
    HelperProcess(HelperProcess&& other) noexcept;
    HelperProcess& operator=(HelperProcess&& other) noexcept;
    ~HelperProcess();

    /// Starts the program at this path. `file` is the descriptor of the open file; the child receives a duplicate of it.
    static Result<HelperProcess> start(const std::string& program, int file, const std::string& argument = protocol);
    pid_t pid() const { return child_; }

    /// Sends a message. An error is ignored, because receive() reports that the child has exited.
    void send(const std::string& message) { (void)send_message(socket_.get(), message); }
    /// Receives the next message of the child. If the child crashes or does not respond in time, returns an error at the file `path`; its
    /// message names `library`, the library with which the child reads.
    Result<std::string> receive(const std::string& path, const std::string& library);
};

/// The path of an installed helper program. If the environment variable CORPUSCLE_LIBEXEC is set, searches only the directory that it
/// names. Otherwise searches the directory of the running program, then ../libexec/corpuscle relative to that directory, then the libexec
/// directory of the install prefix.
Result<std::string> find_helper_program(const std::string& name);

}  // namespace corpuscle
