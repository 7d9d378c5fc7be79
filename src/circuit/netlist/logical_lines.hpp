#pragma once
// The logical lines of a netlist: comments are removed, and a line is joined with the physical lines that continue it. The location of each
// byte in the file is kept.

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"

namespace corpuscle::circuit {

/// A logical line in small letters, except for text in double quotes and for lines that name files.
struct LogicalLine {
    /// From offset `at` on, the text comes from this physical line and column of the file, both counted from 1.
    struct Segment {
        std::uint32_t at, line, column;
    };
    std::string text;
    std::vector<Segment> segments;            ///< in order of their offsets
    std::shared_ptr<const std::string> file;  ///< path; null if the line was not read from a file

    std::vector<std::uint32_t> capitals;  ///< offsets of capital F and M, which users often take for farad and mega

    /// The location in the file of the character at this offset of the text.
    SourceLocation location(std::size_t at = 0) const;
    /// True if the character at this offset was a capital F or M in the file.
    bool was_capital(std::size_t at) const;
};

/// Reads the logical lines of a file one at a time.
class LogicalLineReader {
    std::shared_ptr<const std::string> file_;
    std::string_view rest_;       // the text that is not read yet
    std::string_view last_;       // rest_ before the last call of take(), for put_back()
    std::uint32_t number_ = 0;    // number of the physical line that was taken last, from 1
    LogicalLine next_;            // the logical line being read; further physical lines may continue it
    char quote_ = 0;              // the quote that is open at the end of next_; 0 if no quote is open
    std::uint32_t quote_at_ = 0;  // its offset in next_.text
    bool has_next_ = false;       // true if next_ has begun

public:
    LogicalLineReader(std::string_view text, std::shared_ptr<const std::string> file);

    /// Reads the first line, which is the title in the main file of a netlist, as UTF-8. Call it before next().
    Result<std::string> title();
    /// Reads the next logical line. Returns false at the end of the file.
    Result<bool> next(LogicalLine&);
    /// Skips all physical lines up to and including the first that begins with `word`. Returns false if no line does.
    bool skip_past(std::string_view word);

private:
    bool take(std::string_view& physical);  // reads the next physical line; false at the end of the file
    void put_back();                        // undoes the last take()
    Result<void> append(std::string_view physical, std::size_t from);
    Result<bool> finish_line(LogicalLine&);
};

}  // namespace corpuscle::circuit
