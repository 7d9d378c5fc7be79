#include "cli/output/terminal.hpp"

#include <unistd.h>
#include <algorithm>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <thread>

#include "core/text/input_files.hpp"
#include "run/ranks.hpp"

namespace corpuscle {
namespace {

volatile std::sig_atomic_t stop = 0;       // 1 after the first signal
volatile std::sig_atomic_t stop_time = 0;  // milliseconds() at the first signal

/// Time of a monotonic clock in ms, modulo 1e9 ms (twelve days). Safe in a signal handler.
int milliseconds() {
    timespec now = {};
    ::clock_gettime(CLOCK_MONOTONIC, &now);
    return static_cast<int>((now.tv_sec % 1'000'000) * 1000 + now.tv_nsec / 1'000'000);
}

/// A path without its directories: "x.csv" for "out/x.csv". Text that is not a path, such as "1/4" or "5mV/K", is returned unchanged.
std::string file_name_of(const std::string& part) {
    if (part.find('/') == std::string::npos) return part;
    const std::filesystem::path path(part);
    std::error_code status;
    const auto name = path.has_filename() ? path.filename() : path.parent_path().filename();
    const bool is_file = path.has_extension() || part.starts_with('/') || part.starts_with('.') || part.starts_with('~') ||
                         std::filesystem::exists(path, status) || !std::isdigit(static_cast<unsigned char>(part[0]));
    return is_file && !name.empty() ? name.string() : part;
}

/// Removes directories from all paths in an argument such as "--layout=/home/me/pad.csv" or "sa1,/home/me/x.cir".
std::string without_directories(const std::string& argument) {
    std::string out;
    for (std::size_t at = 0; at <= argument.size();) {
        const auto end = std::min(argument.find_first_of("=,", at), argument.size());
        out += file_name_of(argument.substr(at, end - at));
        if (end < argument.size()) out += argument[end];
        at = end + 1;
    }
    return out;
}

}  // namespace

void print_message(const std::string& message) { fmt::print(stderr, "corpuscle: {}\n", printable(message)); }
void print_warning(const std::string& message) { print_message("warning: " + message); }
void print_notes(const std::string& name, const std::vector<std::string>& notes, bool quiet) {
    for (const auto& note : notes)
        if (!quiet) print_message(fmt::format("{}: {}", name, note));
}
void print_text(const std::string& text) { fmt::print("{}", printable_lines(text)); }

Result<void> finish_output() {
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return {};
    return bad_input(fmt::format("cannot write all of standard output: {}", std::strerror(errno)));
}

int report_error(const Error& error) {
    print_message(error.text());
    if (error.further)
        for (const auto& other : *error.further) print_message(other.text());
    return static_cast<int>(error.code);
}

int report_error_once(const Error& error) {
    if (Ranks::reports_errors()) return report_error(error);
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    return static_cast<int>(error.code);
}

int exit_status(const Result<void>& done) { return done ? 0 : report_error(done.error()); }

void catch_interrupt() {
    struct sigaction action = {};  // without SA_RESTART, so that blocked calls end
    // The command timeout, terminals and launchers can signal the program itself and then its process group, so that one signal arrives
    // twice. Signals within 500 ms of the first therefore count as one.
    action.sa_handler = [](int) {
        constexpr int same_signal = 500;  // ms
        const int now = milliseconds();
        if (stop && (now - stop_time < 0 || now - stop_time > same_signal)) std::_Exit(130);
        if (!stop) stop_time = now;
        stop = 1;
    };
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) ::sigaction(signal, &action, nullptr);
    set_interruption_check(interrupted);
    std::signal(SIGPIPE, SIG_IGN);  // a closed pipe (| head) is then reported as a write error
}

bool interrupted() { return stop != 0; }

std::string time_text(double seconds) {
    const auto s = std::lround(seconds);
    return s < 60     ? fmt::format("{} s", s)
           : s < 3600 ? fmt::format("{}:{:02} min", s / 60, s % 60)
                      : fmt::format("{}:{:02} h", s / 3600, s / 60 % 60);
}

Progress::Progress(bool quiet) : is_enabled_(!quiet && ::isatty(STDERR_FILENO)) {}

Progress::~Progress() {
    if (is_visible_) fmt::print(stderr, "\r\033[K");
}

void Progress::update(double fraction) {
    if (!is_enabled_) return;
    const auto now = Clock::now();
    const double elapsed = std::chrono::duration<double>(now - start_).count();
    if (elapsed < 1 || (is_visible_ && now - last_ < std::chrono::milliseconds(100))) return;
    last_ = now;
    is_visible_ = true;
    const auto full = static_cast<std::size_t>(std::clamp(fraction, 0.0, 1.0) * 32);
    const auto left = fraction > 0 ? time_text(elapsed / fraction - elapsed) + " left" : std::string("...");
    fmt::print(stderr, "\r\033[K[{}{}] {:3.0f} %  {}", std::string(full, '='), std::string(32 - full, ' '), 100 * fraction, left);
    std::fflush(stderr);
}

std::string quote_command(std::span<const std::string> words, bool directories) {
    constexpr std::string_view safe_characters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:%@";
    std::string text = "corpuscle";
    for (const auto& word : words) {
        const auto argument = directories ? word : without_directories(word);
        if (!argument.empty() && argument.find_first_not_of(safe_characters) == std::string::npos) {
            text += " " + argument;
            continue;
        }
        text += " '";
        for (const char c : argument) text += c == '\'' ? "'\\''" : std::string(1, c);
        text += "'";
    }
    return text;
}

}  // namespace corpuscle
