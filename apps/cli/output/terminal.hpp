#pragma once
// Terminal input and output: messages, tables, a progress bar, and Ctrl-C.

#include <fmt/format.h>
#include <chrono>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace corpuscle {

/// Prints an error, and the further ones that it holds, on standard error. Returns the exit status of its code.
int report_error(const Error&);
/// The exit status of a verb; prints the error, if there is one.
int exit_status(const Result<void>& done);

/// Prints one line on standard error. A message begins with "corpuscle:", a warning with "corpuscle: warning:". Control characters are
/// escaped.
void print_message(const std::string& message);
void print_warning(const std::string& message);
/// Prints a message for each note about `name`, unless `quiet`.
void print_notes(const std::string& name, const std::vector<std::string>& notes, bool quiet);

// Names come from untrusted files: a control character in one could move the cursor, set the window title or forge a message. Control
// characters are therefore never printed raw.

/// Escapes control characters, line breaks, bidirectional marks and bytes that are not UTF-8: \x1b, \n, \u202e, \xff.
std::string printable(std::string_view);

/// The same, but keeps line breaks; for text of several lines that the program composed.
std::string printable_lines(std::string_view);

/// The width of a UTF-8 text in columns of a terminal, one per character.
std::size_t columns_of(std::string_view);

/// The text of a JSON document, in which the same characters are escaped as JSON does it (\u202e). The content is unchanged, except that
/// bytes that are not UTF-8 are replaced.
std::string json_text(const nlohmann::ordered_json&);

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

/// The rows of a table, each with its cells.
using TableRows = std::vector<std::vector<std::string>>;

/// Formats rows as a table: columns are padded to their widest cell, columns of numbers are aligned right, others left. If `has_heading`,
/// the first row is the heading. In a table wider than 100 columns the heading is wrapped; if it is still too wide, the table is split into
/// blocks.
std::string format_table(const TableRows& rows, bool has_heading = true);

/// A row of a table.
template <class... T>
std::vector<std::string> table_row(const T&... cells) {
    return {fmt::format("{}", cells)...};
}

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

/// The command line quoted for a shell. Without `directories`, files appear without theirs, so that a published page does not reveal them.
std::string quote_command(int argc, const char* const* argv, bool directories);

}  // namespace corpuscle
