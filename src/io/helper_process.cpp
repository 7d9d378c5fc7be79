#include "io/helper_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <utility>

namespace corpuscle {
namespace {

constexpr std::uint64_t longest_message = std::uint64_t{1} << 30;
constexpr std::size_t piece = std::size_t{1} << 20;

bool send_all(int socket, const void* data, std::size_t size) {
    for (const char* at = static_cast<const char*>(data); size > 0;) {
        const auto sent = ::send(socket, at, size, MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR) continue;
        if (sent <= 0) return false;
        at += sent, size -= static_cast<std::size_t>(sent);
    }
    return true;
}

bool receive_all(int socket, void* data, std::size_t size) {
    for (char* at = static_cast<char*>(data); size > 0;) {
        const auto got = ::recv(socket, at, size, 0);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return false;
        at += got, size -= static_cast<std::size_t>(got);
    }
    return true;
}

/// Bytes of addresses in use: a limit below that would forbid everything.
std::uint64_t memory_in_use() {
    unsigned long long pages = 0;
    if (std::FILE* f = std::fopen("/proc/self/statm", "r")) {
        if (std::fscanf(f, "%llu", &pages) != 1) pages = 0;
        std::fclose(f);
    }
    return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

void limit(__rlimit_resource what, std::uint64_t to) {
    const rlimit r{to, to};
    (void)::setrlimit(what, &r);
}

/// Nothing of the parent but memory: no descriptors, no handlers, no terminal; no core, and bounded memory.
int become_child(int socket) {
    for (const int s : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGALRM, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGPIPE})
        std::signal(s, SIG_DFL);
    sigset_t none;
    ::sigemptyset(&none);
    ::sigprocmask(SIG_SETMASK, &none, nullptr);
    const int nowhere = ::open("/dev/null", O_RDWR);
    if (socket < 3) socket = ::fcntl(socket, F_DUPFD, 3);
    for (int k = 0; k < 3; ++k) ::dup2(nowhere, k);
    if (socket != 3) ::dup2(socket, 3);
    ::close_range(4, ~0U, 0);
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_AS, memory_in_use() + HelperProcess::memory);
    return 3;
}

}  // namespace

bool Message::get(void* data, std::size_t size) {
    if (bytes_.size() - at_ < size) return false;
    std::memcpy(data, bytes_.data() + at_, size);
    at_ += size;
    return true;
}

bool Message::get(std::string& s) {
    std::uint64_t size = 0;
    if (!get(size) || bytes_.size() - at_ < size) return false;
    s = bytes_.substr(at_, size);
    at_ += size;
    return true;
}

bool Message::send(int socket) const {
    const std::uint64_t size = bytes_.size();
    return send_all(socket, &size, sizeof size) && send_all(socket, bytes_.data(), bytes_.size());
}

bool Message::receive(int socket) {
    std::uint64_t size = 0;
    bytes_.clear();
    at_ = 0;
    if (!receive_all(socket, &size, sizeof size) || size > longest_message) return false;
    while (bytes_.size() < size) {
        const auto had = bytes_.size();
        bytes_.resize(had + std::min<std::size_t>(piece, size - had));
        if (!receive_all(socket, bytes_.data() + had, bytes_.size() - had)) return false;
    }
    return true;
}

HelperProcess::HelperProcess(HelperProcess&& o) noexcept : socket_(std::exchange(o.socket_, -1)), child_(std::exchange(o.child_, -1)) {}

HelperProcess& HelperProcess::operator=(HelperProcess&& o) noexcept {
    std::swap(socket_, o.socket_), std::swap(child_, o.child_);
    return *this;
}

HelperProcess::~HelperProcess() {
    if (socket_ >= 0) ::close(socket_);
    if (child_ <= 0) return;
    ::kill(child_, SIGKILL);
    while (::waitpid(child_, nullptr, 0) < 0 && errno == EINTR) {
    }
}

Result<HelperProcess> HelperProcess::start(const std::function<void(int)>& work) {
    int ends[2];
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
        return bad_input(fmt::format("no process can be started to read it: {}", std::strerror(errno)));
    HelperProcess helper;
    helper.socket_ = ends[0];
    const pid_t child = ::fork();
    if (child == 0) {
        const int socket = become_child(ends[1]);
        ::alarm(seconds_to_answer);
        work(socket);
        ::_exit(0);
    }
    ::close(ends[1]);
    if (child < 0) return bad_input(fmt::format("no process can be started to read it: {}", std::strerror(errno)));
    helper.child_ = child;
    return helper;
}

Result<Message> HelperProcess::answer(const std::string& path, const std::string& library) {
    Message m;
    if (m.receive(socket_)) return m;
    return death(path, library);
}

Error HelperProcess::death(const std::string& path, const std::string& library) {
    int status = 0;
    const pid_t child = std::exchange(child_, -1);
    if (child > 0) ::kill(child, SIGKILL);  // one that broke the line without dying
    while (child > 0 && ::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    if (signal == SIGINT || signal == SIGTERM || signal == SIGHUP) return {Code::interrupted, "interrupted", {path}};
    if (signal == SIGALRM)
        return bad_input(fmt::format("{} did not read this file within {} s: damaged?", library, seconds_to_answer), {path});
    const auto how = signal ? fmt::format("signal {}", signal) : fmt::format("status {}", WEXITSTATUS(status));
    return bad_input(fmt::format("{} could not read this file ({}): damaged?", library, how), {path});
}

bool next_question(int socket, Message& m) {
    if (!m.receive(socket)) return false;
    ::alarm(HelperProcess::seconds_to_answer);
    return true;
}

bool give_answer(int socket, const Message& m) {
    ::alarm(0);
    return m.send(socket);
}

}  // namespace corpuscle
