#pragma once
// The logical lines of a netlist: comments are removed and continuation lines joined. The source location of each byte is kept.

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "signal/error.hpp"

namespace corpuscle::circuit {

/// A logical line in small letters, except for text in double quotes and for lines that name files.
struct LogicalLine {
    /// From offset `at` on, the text comes from this line and column of the file.
    struct Segment {
        std::uint32_t at, line, column;
    };
    std::string text;
    std::vector<Segment> segments;
    std::shared_ptr<const std::string> file;

    std::vector<std::uint32_t> capitals;  ///< offsets of capital F and M, which users often mean differently from SPICE

    /// The location in the file of the character at this offset of the text.
    SourceLocation location(std::size_t at = 0) const;
    /// True if the character at this offset was a capital F or M in the file.
    bool was_capital(std::size_t at) const;
};

/// Reads the logical lines of a file one at a time.
class LogicalLineReader {
    std::shared_ptr<const std::string> file_;
    std::string_view rest_, last_;  // the text that is not read yet; the same before the last take(), for put_back()
    std::uint32_t number_ = 0;      // number of the physical line that was taken last
    LogicalLine next_;              // the line being read; following lines may continue it
    char quote_ = 0;                // the quote that is open at the end of next_; 0 if none
    std::uint32_t quote_at_ = 0;
    bool has_next_ = false;

public:
    LogicalLineReader(std::string_view text, std::shared_ptr<const std::string> file);

    /// The first line of the main file, which is its title, as UTF-8.
    Result<std::string> title();
    /// Reads the next line. Returns false at the end.
    Result<bool> next(LogicalLine&);
    /// Skips all lines up to and including the one that begins with `word`. Returns false if there is none.
    bool skip_past(std::string_view word);

private:
    bool take(std::string_view& physical);
    void put_back();
    Result<void> append(std::string_view physical, std::size_t from);
    Result<bool> finish_line(LogicalLine&);
};

}  // namespace corpuscle::circuit
