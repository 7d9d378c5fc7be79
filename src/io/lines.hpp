#pragma once
// A text file line by line, read in blocks; memory is bounded by the longest line allowed.

#include <memory>
#include <string>
#include <string_view>

#include "io/text_input.hpp"
#include "signal/error.hpp"

namespace corpuscle {

class Lines {
    std::string path_;
    std::unique_ptr<TextInput> input_;
    std::string buffer_;                 // what was read, and `behind` bytes more
    std::size_t filled_ = 0;             // of the buffer
    std::size_t at_ = 0;                 // of the next line, in the buffer
    long number_ = 0;                    // of the last line given
    double read_ = 0;                    // bytes
    bool ended_ = false, lost_ = false;  // lost_: the beginning is no longer in the buffer

    Result<bool> fill();

public:
    static constexpr std::size_t longest = std::size_t{64} << 20;
    static constexpr std::size_t behind = 8;  ///< bytes that may be read behind any line

    static Result<Lines> open(const std::string& path);
    /// The next line without its end (LF, CRLF); false at the end of the file. The view lives until the next call.
    Result<bool> next(std::string_view& line);
    Result<void> rewind();
    long number() const { return number_; }
    const std::string& path() const { return path_; }
    /// The shell's command that runs a filter, such as "head -n 9", on this text and writes a file which is not there yet, named after
    /// this one and `mark`: "head -n 9 < press.csv > press-first.csv"; "" if there is no file to read it from.
    std::string copy_command(const std::string& filter, const std::string& mark) const;
    double done() const { return read_ > 0 ? input_->done() * (read_ - static_cast<double>(filled_ - at_)) / read_ : input_->done(); }
};

}  // namespace corpuscle
