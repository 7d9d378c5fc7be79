#pragma once
// Seekable sequences of bytes of known size, from a file or from a member of a zip archive. Reads and writes zip archives with libzip.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/error.hpp"

struct zip;

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

/// An open zip archive.
class Archive {
    std::string path_;
    std::shared_ptr<zip> zip_;

public:
    struct Member {
        std::string name;
        std::uint64_t size;  ///< uncompressed, as stated by the archive
    };

    static bool is_supported();  ///< false in the WebAssembly engine of the page, which has no libzip
    static Result<Archive> open(const std::string& path);
    const std::string& path() const { return path_; }
    const std::vector<Member>& members() const { return members_; }
    /// The uncompressed bytes of a member, given by its index in members(). `name` is the member's name for messages. Seeking is slow in a
    /// compressed member.
    Result<std::unique_ptr<SeekableBytes>> bytes(std::size_t member, std::string name) const;

private:
    std::vector<Member> members_;
};

/// A member of an archive to write.
struct ArchiveEntry {
    std::string name, bytes;  ///< the name in the archive, and the content
};

/// The bytes of an archive with these members, uncompressed. The date of all members is 1980-01-01, so that equal members give an equal
/// archive.
Result<std::string> make_archive(const std::vector<ArchiveEntry>&);

}  // namespace corpuscle
