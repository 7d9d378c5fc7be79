#pragma once
// Reads a text file line by line. The memory needed is bounded by the longest allowed line.

#include "io/text/text_input.hpp"

namespace corpuscle {

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
