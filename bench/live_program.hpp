#pragma once
// The program under test, the sender of its frames, and the reader of its events. Included only by live.cpp.

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <cmath>
#include <cstring>
#include <ctime>
#include <fstream>
#include <thread>

#include "core/random.hpp"
#include "io/output/descriptor.hpp"
#include "io/spikes/address_events.hpp"
#include "live/input/frame_source.hpp"
#include "live/input/sockets.hpp"
#include "skin/innervation.hpp"

namespace corpuscle {

/// Binds the calling thread to the cores `first` to `last`.
inline void bind_to(int first, int last) {
    cpu_set_t cores;
    CPU_ZERO(&cores);
    for (int c = first; c <= last; ++c) CPU_SET(static_cast<std::size_t>(c), &cores);
    ::sched_setaffinity(0, sizeof cores, &cores);
}

/// Sleeps until a time of the monotonic clock, ns.
inline void sleep_until(std::int64_t ns) {
    const timespec at = {ns / 1'000'000'000, ns % 1'000'000'000};
    while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &at, nullptr) == EINTR) {
    }
}

/// The frames of one second, [frame][site], N; the sender repeats them. A contact moves once around a circle; `noise`: as of 1 to 5 mN on
/// each afferent, at every site. `contact_radius`: m; `circle_radius`: m, 0: an ellipse of half the size of the skin.
inline std::vector<float> frames_of_a_second(const SkinPlan& plan, int rate, double contact_radius, bool noise, double circle_radius = 0) {
    const auto& sites = plan.sites;
    // the force at every site, N, under which an afferent responds as to 1 N
    const double scale = plan.felt_area > 0 && sites.area > 0 ? sites.area / plan.felt_area : 1;
    std::vector<float> out(sites.size() * static_cast<std::size_t>(rate));
    Position low = sites.positions[0], high = low;
    for (const auto& p : sites.positions)
        low = {std::min(low.x, p.x), std::min(low.y, p.y)}, high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    for (int k = 0; k < rate; ++k) {
        const double angle = 6.283185307179586 * k / rate;
        const double x = (low.x + high.x) / 2 + (circle_radius > 0 ? circle_radius : (high.x - low.x) / 4) * std::cos(angle),
                     y = (low.y + high.y) / 2 + (circle_radius > 0 ? circle_radius : (high.y - low.y) / 4) * std::sin(angle);
        for (std::size_t s = 0; s < sites.size(); ++s) {
            const double d2 =
                (sites.positions[s].x - x) * (sites.positions[s].x - x) + (sites.positions[s].y - y) * (sites.positions[s].y - y);
            const auto w = philox({static_cast<std::uint32_t>(k), static_cast<std::uint32_t>(s), 0, 0}, 1);
            out[static_cast<std::size_t>(k) * sites.size() + s] = static_cast<float>(
                scale * ((d2 < 6 * contact_radius * contact_radius ? 2 * std::exp(-d2 / (contact_radius * contact_radius)) : 0) +
                         (noise ? 1e-3 + 4e-3 * unit_interval(w[0], w[1]) : 0)));
        }
    }
    return out;
}

/// The program under test, as a child process with pipes.
struct Program {
    pid_t pid = 0;
    Descriptor in, out, err;  // this process's ends: writes to `in`, reads from `out` and `err`
    rusage used = {};         // resources, after wait()

    Program(const std::string& path, std::vector<std::string> arguments, int core) {
        int pipes[3][2];
        for (auto& p : pipes)
            if (::pipe2(p, O_CLOEXEC) != 0) std::exit(1);
        ::fcntl(pipes[0][0], F_SETPIPE_SZ, 1 << 20);
        arguments.insert(arguments.begin(), {path, "stream"});
        std::vector<char*> argument_pointers;
        for (auto& w : arguments) argument_pointers.push_back(w.data());
        argument_pointers.push_back(nullptr);
        if ((pid = ::fork()) < 0) fmt::print(stderr, "fork failed\n"), std::exit(1);
        if (pid == 0) {
            bind_to(core, core);
            ::dup2(pipes[0][0], 0), ::dup2(pipes[1][1], 1), ::dup2(pipes[2][1], 2);
            ::execv(argument_pointers[0], argument_pointers.data());
            ::_exit(127);
        }
        in = Descriptor(pipes[0][1]), out = Descriptor(pipes[1][0]), err = Descriptor(pipes[2][0]);
        ::close(pipes[0][0]), ::close(pipes[1][1]), ::close(pipes[2][1]);
    }
    /// Waits for its end and returns its exit status.
    int wait() {
        int status = 0;
        ::wait4(pid, &status, 0, &used);
        return WEXITSTATUS(status);
    }
    /// Reads one of its outputs to the end.
    std::string read_output(int fd) const {
        std::string all;
        char piece[4096];
        for (ssize_t n = 0; (n = ::read(fd, piece, sizeof piece)) > 0;) all.append(piece, static_cast<std::size_t>(n));
        return all;
    }
    /// Its processor time so far, user and system, s.
    double processor_seconds() const {
        std::ifstream stat(fmt::format("/proc/{}/stat", pid));
        std::string word;
        double user = 0, system = 0;
        for (int k = 1; k < 14; ++k) stat >> word;
        stat >> user >> system;
        return (user + system) / static_cast<double>(::sysconf(_SC_CLK_TCK));
    }
    /// Its processor time in total, user and system, s; after wait().
    double final_processor_seconds() const {
        const auto s = [](const timeval& t) { return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec); };
        return s(used.ru_utime) + s(used.ru_stime);
    }
};

/// Connects to the address that the program prints when it listens.
inline Descriptor connect_to(const Program& child) {
    pollfd wait = {child.err.get(), POLLIN, 0};
    ::poll(&wait, 1, 10000);
    std::string message(200, '\0');
    message.resize(static_cast<std::size_t>(std::max<ssize_t>(0, ::read(child.err.get(), message.data(), message.size()))));
    const auto at = message.find("127.");
    auto to = at < message.size() ? connect_socket(*resolve(*parse_endpoint(message.substr(at, message.find('\n') - at))), 5000)
                                  : Result<Descriptor>(bad_input("the program does not listen: " + message));
    if (!to) fmt::print("{}\n", to.error().text()), std::exit(1);
    ::fcntl(to->get(), F_SETFL, 0);
    return std::move(*to);
}

/// Sends each frame at its scheduled time, and records when its write starts.
class Sender {
    const std::vector<float>& second_;  // the frames of one second
    std::size_t sites_;
    int rate_;                                        // Hz
    bool numbered_;                                   // each frame is preceded by its number
    std::vector<char> bytes_;                         // number and forces of one frame
    std::int64_t begin_ = steady_now() + 10'000'000;  // scheduled time of frame 0, ns

public:
    std::vector<std::int64_t> sent_at;  // for each frame: time at which its write started, ns

    Sender(const std::vector<float>& second, std::size_t sites, int rate, std::int64_t count, bool numbered)
        : second_(second), sites_(sites), rate_(rate), numbered_(numbered), bytes_(4 + sites * sizeof(float)),
          sent_at(static_cast<std::size_t>(count)) {}
    /// Scheduled time of frame k, ns.
    std::int64_t due(std::int64_t k) const { return begin_ + k * 1'000'000'000 / rate_; }
    /// Time at which the write of frame k started, ns. Another thread may call this.
    std::int64_t sent(std::int64_t k) const { return __atomic_load_n(&sent_at[static_cast<std::size_t>(k)], __ATOMIC_ACQUIRE); }
    void send(int fd, std::int64_t k) {
        const auto number = static_cast<std::uint32_t>(k);
        std::memcpy(bytes_.data(), &number, 4);
        std::memcpy(bytes_.data() + 4, second_.data() + static_cast<std::size_t>(k % rate_) * sites_, sites_ * sizeof(float));
        std::string_view left(bytes_.data(), bytes_.size());
        if (!numbered_) left.remove_prefix(4);
        __atomic_store_n(&sent_at[static_cast<std::size_t>(k)], steady_now(), __ATOMIC_RELEASE);
        while (!left.empty()) {
            const auto n = ::write(fd, left.data(), left.size());
            if (n < 0) return;
            left.remove_prefix(static_cast<std::size_t>(n));
        }
    }
    void send_all(int fd) {
        for (std::int64_t k = 0; k < static_cast<std::int64_t>(sent_at.size()); ++k) sleep_until(due(k)), send(fd, k);
    }
};

/// Reads events as they arrive. Calls each(event, time) for every event, with the time of its read, ns.
template <class Each>
class EventReader {
    int fd_;
    std::size_t header_, filled_ = 0;  // bytes of the header still to skip; bytes in the buffer
    Each each_;
    std::vector<char> buffer_ = std::vector<char>(1 << 20);

public:
    EventReader(int fd, std::size_t header, Each each) : fd_(fd), header_(header), each_(std::move(each)) {}
    /// Processes the result of one read. Returns false at the end, or if a non-blocking read finds nothing.
    bool read() {
        const auto n = ::read(fd_, buffer_.data() + filled_, buffer_.size() - filled_);
        if (n <= 0) return false;
        const auto now = steady_now();
        filled_ += static_cast<std::size_t>(n);
        std::size_t at = std::min(header_, filled_);
        header_ -= at;
        for (; filled_ - at >= address_events::spike_bytes; at += address_events::spike_bytes) {
            address_events::EncodedSpike spike;
            std::memcpy(&spike, buffer_.data() + at, sizeof spike);
            each_(spike, now);
        }
        std::memmove(buffer_.data(), buffer_.data() + at, filled_ -= at);
        return true;
    }
};

}  // namespace corpuscle
