#pragma once
// A seekable sequence of bytes of known size, from a file or from a member of an archive.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "core/error.hpp"

namespace corpuscle {

class SeekableBytes {
public:
    virtual ~SeekableBytes() = default;
    /// The path of the file, followed by the name of the member if it is one, for messages.
    virtual const std::string& name() const = 0;
    virtual std::uint64_t size() const = 0;  ///< bytes
    /// Reads the next bytes. Fills `out` completely, or returns an error.
    virtual Result<void> read(std::span<std::byte> out) = 0;
    /// Moves to position `at`, counted from the beginning.
    virtual Result<void> seek(std::uint64_t at) = 0;
};

/// Opens a regular file.
Result<std::unique_ptr<SeekableBytes>> open_bytes(const std::string& path);

/// Copies all bytes to a temporary file without a name, in which seeking is fast.
Result<std::unique_ptr<SeekableBytes>> copy_to_temporary_file(SeekableBytes&);

}  // namespace corpuscle
