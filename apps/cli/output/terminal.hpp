#pragma once
// Terminal input and output: messages, tables, a progress bar, and Ctrl-C.

#include <fmt/format.h>
#include <chrono>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/text/aligned_table.hpp"
#include "core/text/printable.hpp"

namespace corpuscle {

/// Prints an error, and the further ones that it holds, on standard error. Returns the exit status of its code.
int report_error(const Error&);
/// As report_error(), for a command that mpirun may have started as several ranks: rank 0 prints the error, and the others wait for it,
/// because mpirun ends all ranks when one ends with an error.
int report_error_once(const Error&);
/// The exit status of a verb; prints the error, if there is one.
int exit_status(const Result<void>& done);

/// Prints one line on standard error. A message begins with "corpuscle:", a warning with "corpuscle: warning:". Control characters are
/// escaped.
void print_message(const std::string& message);
void print_warning(const std::string& message);
/// Prints a message for each note about `name`, unless `quiet`.
void print_notes(const std::string& name, const std::vector<std::string>& notes, bool quiet);

/// Prints text of several lines on standard output. Control characters are escaped.
void print_text(const std::string& text);

/// Flushes standard output. Returns an error if some of the text could not be written.
Result<void> finish_output();

/// Installs the signal handlers. The first Ctrl-C makes interrupted() true and ends a blocked read; the second ends the program.
void catch_interrupt();
/// True after Ctrl-C or another signal that ends the program.
bool interrupted();

/// The function of a verb that runs until it is done, fails or is interrupted, with arguments that are shared with its options.
template <class Arguments, class Common>
auto interruptible(std::shared_ptr<Arguments> args, Result<void> (*work)(const Arguments&, const Common&)) {
    return [args, work](const Common& common) {
        catch_interrupt();
        return exit_status(work(*args, common));
    };
}

/// A duration as text: "12 s", "3:05 min", "2:10 h".
std::string time_text(double seconds);

/// A progress bar with the remaining time, on standard error. It appears only if this is a terminal, and after one second.
class Progress {
    using Clock = std::chrono::steady_clock;
    bool is_enabled_;
    Clock::time_point start_ = Clock::now(), last_ = start_;
    bool is_visible_ = false;

public:
    explicit Progress(bool quiet);
    ~Progress();
    /// `fraction`: 0 to 1.
    void update(double fraction);
};

/// The command line of corpuscle with these words, quoted for a shell. Without `directories`, files appear without theirs, so that a
/// published page does not reveal them.
std::string quote_command(std::span<const std::string> words, bool directories);

}  // namespace corpuscle
