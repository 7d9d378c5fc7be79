#pragma once
// Child processes of tests. Signals are sent only to a process that the test started; in particular never to process -1, which means all
// processes.

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

/// Calls fork() and returns its result, which is 0 in the child; throws if it fails.
inline pid_t fork_child() {
    const pid_t id = ::fork();
    if (id < 0) throw std::runtime_error(std::string("fork failed: ") + std::strerror(errno));
    return id;
}

/// Sends a signal to process `id`. Returns true if it was sent. For kill(), ids below 1 mean process groups or all processes; these are
/// never signalled.
inline bool signal_child(pid_t id, int signal) { return id > 0 && ::kill(id, signal) == 0; }

/// True if a pseudo-terminal can be opened. A chroot or a container may lack /dev/ptmx or /dev/pts.
inline bool has_pseudo_terminals() {
    int controller = -1, terminal = -1;
    if (::openpty(&controller, &terminal, nullptr, nullptr, nullptr) != 0) return false;
    ::close(controller), ::close(terminal);
    return true;
}

constexpr const char* no_pseudo_terminals = "no pseudo-terminal is available (/dev/ptmx, /dev/pts)";

}  // namespace corpuscle::test
