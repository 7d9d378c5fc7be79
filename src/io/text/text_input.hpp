#pragma once
// Reads a text file and returns it as UTF-8. The file may be in UTF-8 or UTF-16, and compressed with gzip. The memory needed does not grow
// with the size of the file.

#include <cstddef>
#include <string_view>
#include <vector>

#include "core/error.hpp"

namespace corpuscle {

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

}  // namespace corpuscle
