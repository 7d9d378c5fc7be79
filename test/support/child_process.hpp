#pragma once
// Child processes of tests. A signal goes only to a process that was started: kill(-1, ...) would reach every process of the machine.

#include <fcntl.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <string>

namespace corpuscle::test {

/// fork(), or an exception.
inline pid_t fork_child() {
    const pid_t id = ::fork();
    if (id < 0) throw std::runtime_error(std::string("no process can be started: ") + std::strerror(errno));
    return id;
}

/// Whether the signal was sent. Ids below 1 stand for groups of processes, or for all: they are never signalled.
inline bool signal_child(pid_t id, int signal) { return id > 0 && ::kill(id, signal) == 0; }

/// Whether a pseudo-terminal can be had: a chroot or a container may have no /dev/ptmx or no /dev/pts.
inline bool has_pseudo_terminals() {
    int far = -1, near = -1;
    if (::openpty(&far, &near, nullptr, nullptr, nullptr) != 0) return false;
    ::close(far), ::close(near);
    return true;
}

constexpr const char* no_pseudo_terminals = "no pseudo-terminal can be had here (/dev/ptmx, /dev/pts)";

}  // namespace corpuscle::test
