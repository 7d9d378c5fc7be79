#include "cli/output/terminal.hpp"

#include <unistd.h>
#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <numeric>
#include <sstream>

#include "core/text/input_files.hpp"

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

constexpr std::size_t max_table_width = 100;  // columns; in wider tables the heading has several lines

/// True for a number, or for a mean with its standard deviation: "9.4 +- 1.1".
bool is_number(std::string_view cell) {
    if (const auto sign = cell.find(" +- "); sign != cell.npos) return is_number(cell.substr(0, sign)) && is_number(cell.substr(sign + 4));
    return !cell.empty() && cell.find_first_not_of("0123456789.-+e") == std::string::npos;
}

/// Splits a heading at blanks and after hyphens: "Victor-", "Purpura".
std::vector<std::string> split_heading(const std::string& heading) {
    std::vector<std::string> out;
    std::istringstream input(heading);
    for (std::string word; input >> word;) {
        const auto hyphen = word.find('-', 2);
        if (hyphen != word.npos && hyphen + 2 < word.size())
            out.push_back(word.substr(0, hyphen + 1)), out.push_back(word.substr(hyphen + 1));
        else
            out.push_back(word);
    }
    return out;
}

/// Breaks the heading (the first row) of a table that is too wide into several rows. Returns the number of rows of the heading.
std::size_t wrap_heading(TableRows& rows) {
    if (rows.size() < 2) return 1;
    std::vector<std::size_t> widths(rows[0].size());
    std::size_t total = 0;
    for (std::size_t c = 0; c < rows[0].size(); ++c) {
        for (std::size_t r = 1; r < rows.size(); ++r)
            if (c < rows[r].size()) widths[c] = std::max(widths[c], columns_of(rows[r][c]));
        total += std::max(widths[c], columns_of(rows[0][c])) + (c ? 2 : 0);
    }
    if (total <= max_table_width) return 1;
    TableRows lines;
    for (std::size_t c = 0; c < rows[0].size(); ++c) {
        std::vector<std::string> parts;
        for (const auto& word : split_heading(rows[0][c])) {
            const bool joined = !parts.empty() && parts.back().ends_with('-');
            if (!parts.empty() && columns_of(parts.back()) + (joined ? 0 : 1) + columns_of(word) <= widths[c])
                parts.back() += (joined ? "" : " ") + word;
            else
                parts.push_back(word);
        }
        while (lines.size() < parts.size()) lines.emplace_back(rows[0].size());
        for (std::size_t k = 0; k < parts.size(); ++k) lines[k][c] = parts[k];
    }
    rows.erase(rows.begin());
    rows.insert(rows.begin(), lines.begin(), lines.end());
    return std::max<std::size_t>(lines.size(), 1);
}

/// Splits the columns of a table into blocks that fit a terminal. `widths`, `numeric`: for each column, its width and whether its cells are
/// numbers. Each block has the indexes of its columns. It begins with the text columns before the first numeric one, which name the rows.
std::vector<std::vector<std::size_t>> blocks_of(const std::vector<std::size_t>& widths, const std::vector<bool>& numeric) {
    const auto indices = [](std::size_t from, std::size_t to) {
        std::vector<std::size_t> out(to - from);
        std::iota(out.begin(), out.end(), from);
        return out;
    };
    // Width of the columns from `from` to `to` - 1 with two blanks after each. The last one needs none, so the limits below are
    // max_table_width + 2.
    const auto total_width = [&](std::size_t from, std::size_t to) {
        return std::accumulate(widths.begin() + static_cast<std::ptrdiff_t>(from), widths.begin() + static_cast<std::ptrdiff_t>(to),
                               std::size_t{0}, [](std::size_t total, std::size_t w) { return total + w + 2; });
    };
    const auto name_columns = static_cast<std::size_t>(std::find(numeric.begin(), numeric.end(), true) - numeric.begin());
    if (total_width(0, widths.size()) <= max_table_width + 2 || total_width(0, name_columns) > max_table_width / 2)
        return {indices(0, widths.size())};
    std::vector<std::vector<std::size_t>> blocks;
    for (std::size_t c = name_columns; c < widths.size();) {
        auto end = c + 1;
        while (end < widths.size() && total_width(0, name_columns) + total_width(c, end + 1) <= max_table_width + 2) ++end;
        auto block = indices(0, name_columns);
        for (; c < end; ++c) block.push_back(c);
        blocks.push_back(std::move(block));
    }
    return blocks;
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

std::string format_table(const TableRows& raw_rows, bool has_heading) {
    auto rows = raw_rows;
    for (auto& row : rows)
        for (auto& cell : row) cell = printable(cell);
    const auto heading_rows = has_heading ? wrap_heading(rows) : 0;
    std::vector<std::size_t> widths;
    std::vector<bool> numeric;
    for (std::size_t r = 0; r < rows.size(); ++r)
        for (std::size_t c = 0; c < rows[r].size(); ++c) {
            if (widths.size() <= c) widths.push_back(0), numeric.push_back(true);
            widths[c] = std::max(widths[c], columns_of(rows[r][c]));
            if (r >= heading_rows && !rows[r][c].empty() && !is_number(rows[r][c])) numeric[c] = false;
        }
    std::string text;
    for (const auto& block : blocks_of(widths, numeric)) {
        text += text.empty() ? "" : "\n";
        for (const auto& row : rows) {
            std::string line;
            for (const auto c : block) {
                if (c >= row.size()) continue;
                const std::string pad(widths[c] - columns_of(row[c]), ' ');
                line += (c ? "  " : "") + (numeric[c] ? pad + row[c] : row[c] + pad);
            }
            line.erase(line.find_last_not_of(' ') + 1);
            text += line + "\n";
        }
    }
    return text;
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

std::string quote_command(int argc, const char* const* argv, bool directories) {
    constexpr std::string_view safe_characters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:%@";
    std::string text = "corpuscle";
    for (int k = 1; k < argc; ++k) {
        const auto argument = directories ? std::string(argv[k]) : without_directories(argv[k]);
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
