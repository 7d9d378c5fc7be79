#pragma once
// Runs corpuscle stream as a child process; the test owns the other ends of its pipes and sockets. Included only by
// stream_program_test.cpp.

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "support/child_process.hpp"
#include "support/program.hpp"

namespace corpuscle {
namespace {

using test::TemporaryFolder;

/// The running program. `in` is the test's end of its standard input, `out` that of its standard output; its standard error goes to a file.
/// The destructor kills the program.
class Child {
    pid_t pid_ = -1;
    std::string err_;  // path of the file

public:
    int in = -1, out = -1;

    Child(const TemporaryFolder& folder, std::vector<std::string> options) : err_(folder / "err") {
        int to[2], from[2];
        if (::pipe2(to, O_CLOEXEC) != 0 || ::pipe2(from, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
        options.insert(options.begin(), {test::program_path(), "stream"});
        std::vector<char*> arguments;
        for (auto& option : options) arguments.push_back(option.data());
        arguments.push_back(nullptr);
        std::ofstream(err_).close();
        pid_ = test::fork_child();
        if (pid_ == 0) {
            const int err = ::open(err_.c_str(), O_WRONLY | O_APPEND);
            ::dup2(to[0], 0), ::dup2(from[1], 1), ::dup2(err, 2);
            ::execv(arguments[0], arguments.data());
            ::_exit(127);
        }
        ::close(to[0]), ::close(from[1]);
        in = to[1], out = from[0];
    }
    ~Child() {
        ::close(in), ::close(out);
        if (test::signal_child(pid_, SIGKILL)) ::waitpid(pid_, nullptr, 0);
    }
    void close_in() { ::close(in), in = -1; }
    void close_out() { ::close(out), out = -1; }
    /// Writes to the program's standard input, until it closes that.
    void send(std::string_view text) const {
        while (!text.empty()) {
            const auto count = ::write(in, text.data(), text.size());
            if (count < 0) return;
            text.remove_prefix(static_cast<std::size_t>(count));
        }
    }
    void interrupt() const { test::signal_child(pid_, SIGINT); }
    std::string error_text() const { return test::read_file(err_); }
    /// All that the program writes to its standard output until it closes it.
    std::string read_out() const {
        std::string all;
        char chunk[65536];
        for (ssize_t count = 0; (count = ::read(out, chunk, sizeof chunk)) > 0;) all.append(chunk, static_cast<std::size_t>(count));
        return all;
    }
    /// Waits for the end of the program. Returns its exit status, 128 + signal if a signal ended it, or -1 if it has not ended after 10 s.
    int wait() {
        for (int k = 0; k < 2000; ++k) {
            int status = 0;
            if (::waitpid(pid_, &status, WNOHANG) == pid_) {
                pid_ = -1;
                return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        return -1;
    }
    /// Waits until standard error contains this text. Returns false if it does not within 4 s.
    bool wait_for_text(const std::string& text) const {
        for (int k = 0; k < 2000; ++k) {
            if (error_text().find(text) != std::string::npos) return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
        return false;
    }
    /// The port on which the program listens, from its standard error.
    int port() const {
        EXPECT_TRUE(wait_for_text("listening on 127.0.0.1:")) << error_text();
        return std::stoi(error_text().substr(error_text().find("127.0.0.1:") + 10));
    }
};

void ignore_broken_pipes() { std::signal(SIGPIPE, SIG_IGN); }

sockaddr_in loopback_address(int port) {
    sockaddr_in at = {};
    at.sin_family = AF_INET, at.sin_port = htons(static_cast<std::uint16_t>(port)), at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return at;
}

/// Returns a socket that is connected to the port on this machine.
int connect_to(int port) {
    const int fd = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const auto at = loopback_address(port);
    EXPECT_EQ(::connect(fd, reinterpret_cast<const sockaddr*>(&at), sizeof at), 0);
    return fd;
}

/// Opens a listening socket. `port`: 0 for any. Returns the socket and its port.
std::pair<int, int> listen_on(int port = 0) {
    const int fd = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const int yes = 1;
    ::setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    auto at = loopback_address(port);
    socklen_t size = sizeof at;
    EXPECT_EQ(::bind(fd, reinterpret_cast<const sockaddr*>(&at), sizeof at), 0);
    EXPECT_EQ(::listen(fd, 8), 0);
    ::getsockname(fd, reinterpret_cast<sockaddr*>(&at), &size);
    return {fd, ntohs(at.sin_port)};
}

/// `count` lines with one force each, for frames `first` and following, counted from 0. The force repeats after 400 frames: 100 frames of 0
/// N, then 300 of 2 N.
std::string force_lines(int count, int first = 0) {
    std::string text;
    for (int k = first; k < first + count; ++k) text += std::to_string(k % 400 < 100 ? 0 : 2) + "\n";
    return text;
}

const std::vector<std::string> base_options = {"--rate", "1kHz"};

std::vector<std::string> with_base_options(std::vector<std::string> more) {
    more.insert(more.begin(), base_options.begin(), base_options.end());
    return more;
}

}  // namespace
}  // namespace corpuscle
