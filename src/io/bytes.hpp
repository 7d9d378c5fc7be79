#pragma once
// Bytes of known number, from a file or from what an archive holds, read in pieces and from any place.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "signal/error.hpp"

namespace corpuscle {

class Bytes {
public:
    virtual ~Bytes() = default;
    /// For messages: the file, or the file and what in it.
    virtual const std::string& name() const = 0;
    virtual std::uint64_t size() const = 0;
    /// The next ones: all that fit into `out`, or an error.
    virtual Result<void> read(std::span<std::byte> out) = 0;
    virtual Result<void> seek(std::uint64_t at) = 0;
};

Result<std::unique_ptr<Bytes>> open_bytes(const std::string& path);

/// The same bytes in a nameless temporary file: for those that are slow to seek in.
Result<std::unique_ptr<Bytes>> spooled(Bytes&);

}  // namespace corpuscle
