#pragma once
// What people see of a run: tables, progress, errors; and their Ctrl-C.

#include <chrono>
#include <string>
#include <vector>

#include "signal/error.hpp"

namespace corpuscle {

/// Prints the error on standard error; gives the exit status it stands for.
int fail(const Error&);

/// One line on standard error: "corpuscle: ...", "corpuscle: warning: ...". Control characters are escaped.
void tell(const std::string& sentence);
void tell_warning(const std::string& sentence);

/// Text of several lines on standard output. Control characters are escaped.
void show(const std::string& text);

/// What was printed has reached standard output, or the error that says why not.
Result<void> finish_output();

/// From now on the first Ctrl-C only sets a flag, and ends a read that waits; the second ends the program.
void catch_interrupt();
bool interrupted();

/// "12 s", "3:05 min", "2:10 h".
std::string time_text(double seconds);

/// Columns padded to their widest cell; numbers to the right, words to the left.
std::string table(const std::vector<std::vector<std::string>>& rows);

/// A bar with the time left, on standard error, only to a terminal and only for what takes longer than a second.
class Progress {
    using Clock = std::chrono::steady_clock;
    bool shown_;
    Clock::time_point start_ = Clock::now(), last_ = start_;
    bool drawn_ = false;

public:
    explicit Progress(bool quiet);
    ~Progress();
    void at(double share);
};

/// The words of a command line as a shell would need them, files by their names alone: a page that is given away tells no directories.
std::string quoted(int argc, const char* const* argv);

}  // namespace corpuscle
