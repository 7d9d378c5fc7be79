#pragma once
// The bytes of a file of text as UTF-8: as they stand, out of gzip, out of UTF-16. Memory is bounded whatever the file unpacks to.

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "signal/error.hpp"

namespace corpuscle {

class TextInput {
    std::string ahead_;  // read already, not yet given

    /// Up to `most` bytes; fewer than asked for only at the end.
    virtual Result<std::size_t> fetch(char* to, std::size_t most) = 0;
    virtual Result<void> restart() = 0;

public:
    virtual ~TextInput() = default;
    Result<std::size_t> read(char* to, std::size_t most);
    /// The first bytes, which stay to be read; fewer than `count` only if there are not so many.
    Result<std::string_view> peek(std::size_t count);
    Result<void> rewind();
    /// The share of the file's own bytes that has been read, 0 to 1.
    virtual double done() const = 0;
    /// Commands that make this text of the file's bytes, one after another: "zcat", "iconv -f UTF-16LE -t UTF-8".
    virtual std::vector<std::string> commands() const { return {}; }
};

/// Refuses, by name and with a way to convert it, what is no text: workbooks, other programs' binary files, archives.
Result<std::unique_ptr<TextInput>> open_text_input(const std::string& path);

}  // namespace corpuscle
