#pragma once
// Reads a text file as UTF-8. The file may be in UTF-8 or UTF-16, and compressed with gzip. Memory is bounded for any uncompressed size.

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "signal/error.hpp"

namespace corpuscle {

class TextInput {
    std::string lookahead_;  // bytes read by peek() but not yet by read()

    /// Reads like read(), but after the lookahead.
    virtual Result<std::size_t> fetch(char* to, std::size_t max_bytes) = 0;
    virtual Result<void> restart() = 0;

public:
    virtual ~TextInput() = default;
    /// Reads up to `max_bytes` bytes. Returns fewer only at the end.
    Result<std::size_t> read(char* to, std::size_t max_bytes);
    /// Returns the next bytes without consuming them. Fewer than `count` only at the end.
    Result<std::string_view> peek(std::size_t count);
    Result<void> rewind();
    /// The fraction of the file's bytes that has been read, 0 to 1.
    virtual double progress() const = 0;
    /// Shell commands that convert the file to this text, in order: "zcat", "iconv -f UTF-16LE -t UTF-8".
    virtual std::vector<std::string> shell_commands() const { return {}; }
};

/// A file that is not text (workbooks, binary files of other programs, archives) is an error, which names its format and a command to
/// convert it.
Result<std::unique_ptr<TextInput>> open_text_input(const std::string& path);

}  // namespace corpuscle
