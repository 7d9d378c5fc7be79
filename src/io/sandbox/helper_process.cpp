#include "io/sandbox/helper_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <vector>

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

/// `error` is a value of errno.
Error cannot_start(const std::string& program, int error) {
    return bad_input(fmt::format("{} cannot be started: {}", program, std::strerror(error)));
}

/// A duplicate of a file descriptor, with a number of at least 10. It is thus not overwritten when the descriptors 3 and 4 of the child are
/// created.
Descriptor high_duplicate(int descriptor) { return Descriptor(::fcntl(descriptor, F_DUPFD_CLOEXEC, 10)); }

/// The environment of the child: only the variables for the dynamic linker and the sanitizers. Other variables could make a library load or
/// write files.
std::vector<char*> environment() {
    std::vector<char*> kept;
    for (char** variable = environ; *variable; ++variable)
        for (const char* name : {"LD_LIBRARY_PATH=", "ASAN_OPTIONS=", "UBSAN_OPTIONS=", "TSAN_OPTIONS="})
            if (std::strncmp(*variable, name, std::strlen(name)) == 0) kept.push_back(*variable);
    kept.push_back(nullptr);
    return kept;
}

/// Starts the program with default signal handling and stores its process id in `child`. Its descriptors are /dev/null (0 to 2), the socket
/// (3) and the file (4). Returns 0, or the error number of posix_spawn().
int spawn(const std::string& program, const std::string& argument, int socket, int file, pid_t& child) {
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawnattr_init(&attributes);
    for (int k = 0; k < 3; ++k) ::posix_spawn_file_actions_addopen(&actions, k, "/dev/null", O_RDWR, 0);
    ::posix_spawn_file_actions_adddup2(&actions, socket, HelperProcess::socket_descriptor);
    ::posix_spawn_file_actions_adddup2(&actions, file, HelperProcess::file_descriptor);
    ::posix_spawn_file_actions_addclosefrom_np(&actions, HelperProcess::file_descriptor + 1);
    sigset_t none, all;
    ::sigemptyset(&none);
    ::sigfillset(&all);
    ::posix_spawnattr_setsigmask(&attributes, &none);
    ::posix_spawnattr_setsigdefault(&attributes, &all);
    ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    auto program_copy = program, argument_copy = argument;  // posix_spawn expects char*
    char* arguments[] = {program_copy.data(), argument_copy.data(), nullptr};
    const int failed = ::posix_spawn(&child, program.c_str(), &actions, &attributes, arguments, environment().data());
    ::posix_spawn_file_actions_destroy(&actions);
    ::posix_spawnattr_destroy(&attributes);
    return failed;
}

}  // namespace

bool send_message(int socket, const std::string& message) {
    const std::uint64_t size = message.size();
    return send_all(socket, &size, sizeof size) && send_all(socket, message.data(), message.size());
}

bool receive_message(int socket, std::string& message) {
    std::uint64_t size = 0;
    message.clear();
    if (!receive_all(socket, &size, sizeof size) || size > max_message) return false;
    while (message.size() < size) {
        const auto old_size = message.size();
        message.resize(old_size + std::min<std::size_t>(chunk_bytes, size - old_size));
        if (!receive_all(socket, message.data() + old_size, message.size() - old_size)) return false;
    }
    return true;
}

HelperProcess::HelperProcess(HelperProcess&& o) noexcept
    : socket_(std::move(o.socket_)), child_(std::exchange(o.child_, -1)), program_(std::move(o.program_)) {}

HelperProcess& HelperProcess::operator=(HelperProcess&& o) noexcept {
    socket_ = std::move(o.socket_), std::swap(child_, o.child_), std::swap(program_, o.program_);
    return *this;
}

HelperProcess::~HelperProcess() {
    if (child_ <= 0) return;
    ::kill(child_, SIGKILL);
    while (::waitpid(child_, nullptr, 0) < 0 && errno == EINTR) {
    }
}

Result<HelperProcess> HelperProcess::start(const std::string& program, int file, const std::string& argument) {
    int ends[2];  // of the socket: ours, and the child's
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) return cannot_start(program, errno);
    HelperProcess helper;
    const Descriptor child_end(ends[1]);
    helper.socket_ = Descriptor(ends[0]);
    helper.program_ = program;
    const timeval timeout{response_timeout_s + 5, 0};  // longer than the child's own alarm, which normally ends it first
    (void)::setsockopt(ends[0], SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof timeout);
    const auto socket = high_duplicate(ends[1]), opened = high_duplicate(file);
    if (!socket || !opened) return cannot_start(program, errno);
    pid_t child = -1;
    if (const int failed = spawn(program, argument, socket.get(), opened.get(), child)) return cannot_start(program, failed);
    helper.child_ = child;
    return helper;
}

Result<std::string> HelperProcess::receive(const std::string& path, const std::string& library) {
    std::string message;
    if (receive_message(socket_.get(), message)) return message;
    return failure(path, library);
}

/// The error for a child that sent no message. Ends the child. errno must still be that of receive_message().
Error HelperProcess::failure(const std::string& path, const std::string& library) {
    const bool timed_out = errno == EAGAIN || errno == EWOULDBLOCK;
    int status = 0;
    const pid_t child = std::exchange(child_, -1);
    if (child > 0) ::kill(child, SIGKILL);  // the child may have closed the socket without exiting
    while (child > 0 && ::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    if (signal == SIGINT || signal == SIGTERM || signal == SIGHUP) return {ErrorCode::interrupted, "interrupted", {path}};
    if (timed_out || signal == SIGALRM)
        return bad_input(fmt::format("{} did not read this file within {} s; it may be damaged", library, response_timeout_s), {path});
    if (signal == 0 && WEXITSTATUS(status) == exit_unknown_protocol)
        return bad_input(fmt::format("{} belongs to another version of Corpuscle; install both from the same version", program_), {path});
    const auto reason = signal ? fmt::format("signal {}", signal) : fmt::format("status {}", WEXITSTATUS(status));
    return bad_input(fmt::format("{} could not read this file ({}); it may be damaged", library, reason), {path});
}

}  // namespace corpuscle
