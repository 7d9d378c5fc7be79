#pragma once
// Reads and writes zip archives with libzip.

#include <string>
#include <vector>

#include "io/seekable_bytes.hpp"

struct zip;

namespace corpuscle {

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
    /// The uncompressed bytes of a member. `name` is for messages. Seeking is slow in a compressed member.
    Result<std::unique_ptr<SeekableBytes>> bytes(std::size_t member, std::string name) const;

private:
    std::vector<Member> members_;
};

struct ArchiveEntry {
    std::string name, bytes;
};

/// The bytes of an uncompressed archive. All members have the same constant date, so the same members give the same bytes.
Result<std::string> make_archive(const std::vector<ArchiveEntry>&);

}  // namespace corpuscle
