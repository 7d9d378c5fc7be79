#pragma once
// Reads a text file line by line. The memory needed is bounded by the longest allowed line.

#include <string_view>
#include <vector>

#include "core/error.hpp"

namespace corpuscle {

/// Reads a text file and returns it as UTF-8. The file may be in UTF-8 or UTF-16, and compressed with gzip. The memory needed does not grow
/// with the size of the file.
class TextInput {
    std::string lookahead_;  // bytes that peek() returned and read() has not

    /// Implements read() for the bytes after lookahead_.
    virtual Result<std::size_t> fetch(char* to, std::size_t max_bytes) = 0;
    /// Implements rewind().
    virtual Result<void> restart() = 0;

public:
    virtual ~TextInput() = default;
    /// Reads up to `max_bytes` bytes of UTF-8. Returns their number, which is smaller only at the end of the file.
    Result<std::size_t> read(char* to, std::size_t max_bytes);
    /// The next `count` bytes, which the next read() returns again. There are fewer only at the end of the file.
    Result<std::string_view> peek(std::size_t count);
    /// Continues at the beginning of the file.
    Result<void> rewind();
    /// The fraction of the file's bytes that has been read, 0 to 1.
    virtual double progress() const = 0;
    /// The shell commands that convert the file to this text, one after another: "zcat", "iconv -f UTF-16LE -t UTF-8". Empty if it is plain
    /// UTF-8.
    virtual std::vector<std::string> shell_commands() const { return {}; }
};

/// Opens a text file. A file that is not text (a workbook, a binary file, an archive) is an error; if its format is known, the message
/// names it and a command that converts it.
Result<std::unique_ptr<TextInput>> open_text_input(const std::string& path);

class LineReader {
    std::string path_;
    std::unique_ptr<TextInput> input_;
    std::string buffer_;               // text that was read, then at least `padding` zero bytes
    std::size_t filled_ = 0;           // bytes of the buffer that hold text
    std::size_t position_ = 0;         // position of the next line in the buffer
    long line_number_ = 0;             // number of the last line returned, counted from 1
    double bytes_read_ = 0;            // bytes of text read since the beginning of the file
    bool ended_ = false;               // true after the end of the file was read
    bool is_start_discarded_ = false;  // true if the beginning of the file is no longer in the buffer

    Result<bool> fill();

public:
    static constexpr std::size_t max_line_bytes = std::size_t{64} << 20;  ///< a longer line is an error
    static constexpr std::size_t padding = 8;                             ///< number of bytes after the end of any line that are readable

    static Result<LineReader> open(const std::string& path);
    /// The next line without its line ending (LF, CRLF). Returns false at the end of the file. The view is valid until the next call.
    Result<bool> next(std::string_view& line);
    /// Continues at the first line. An input that cannot be read twice, such as a pipe, can be rewound only while its beginning is in
    /// memory.
    Result<void> rewind();
    /// The number of the last line returned, counted from 1.
    long line_number() const { return line_number_; }
    const std::string& path() const { return path_; }
    /// A shell command that applies `filter`, another shell command, to this file and writes the result to a new file. `mark` is added to
    /// the name of the new file: "head -n 9 < press.csv > press-first.csv" for the filter "head -n 9" and the mark "-first". "" if the
    /// input is not a regular file.
    std::string copy_command(const std::string& filter, const std::string& mark) const;
    /// The fraction of the file in the lines returned so far, 0 to 1.
    double progress() const {
        return bytes_read_ > 0 ? input_->progress() * (bytes_read_ - static_cast<double>(filled_ - position_)) / bytes_read_
                               : input_->progress();
    }
};

}  // namespace corpuscle
