#pragma once
// Reads a text file line by line. Memory is bounded by the longest line allowed.

#include <memory>
#include <string>
#include <string_view>

#include "io/text_input.hpp"
#include "signal/error.hpp"

namespace corpuscle {

class LineReader {
    std::string path_;
    std::unique_ptr<TextInput> input_;
    std::string buffer_;                               // the bytes read, followed by `padding` more bytes
    std::size_t filled_ = 0;                           // bytes of the buffer that hold text
    std::size_t position_ = 0;                         // position of the next line in the buffer
    long line_number_ = 0;                             // number of the last line returned
    double bytes_read_ = 0;                            // from the file
    bool ended_ = false, is_start_discarded_ = false;  // is_start_discarded_: the beginning of the file is no longer in the buffer

    Result<bool> fill();

public:
    static constexpr std::size_t max_line_bytes = std::size_t{64} << 20;
    static constexpr std::size_t padding = 8;  ///< number of bytes after any line that may be read

    static Result<LineReader> open(const std::string& path);
    /// The next line without its line ending (LF, CRLF). Returns false at the end of the file. The view is valid until the next call.
    Result<bool> next(std::string_view& line);
    Result<void> rewind();
    long line_number() const { return line_number_; }
    const std::string& path() const { return path_; }
    /// A shell command that applies a filter, such as "head -n 9", to this file and writes a new file named after this one and `mark`:
    /// "head -n 9 < press.csv > press-first.csv". "" if the input is not a regular file.
    std::string copy_command(const std::string& filter, const std::string& mark) const;
    double progress() const {
        return bytes_read_ > 0 ? input_->progress() * (bytes_read_ - static_cast<double>(filled_ - position_)) / bytes_read_
                               : input_->progress();
    }
};

}  // namespace corpuscle
