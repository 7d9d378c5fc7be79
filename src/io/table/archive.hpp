#pragma once
// Reads and writes zip archives with libzip.

#include <string>
#include <vector>

#include "io/table/seekable_bytes.hpp"

struct zip;

namespace corpuscle {

/// An open zip archive.
class Archive {
    std::string path_;
    std::shared_ptr<zip> zip_;

public:
    struct Member {
        std::string name;
        std::uint64_t size;  ///< uncompressed, as stated by the archive
    };

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
