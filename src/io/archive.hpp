#pragma once
// Zip archives, through libzip: what is in one, and one made of bytes.

#include <string>
#include <vector>

#include "io/bytes.hpp"

struct zip;

namespace corpuscle {

class Archive {
    std::string path_;
    std::shared_ptr<zip> zip_;

public:
    struct Member {
        std::string name;
        std::uint64_t size;  ///< unpacked, as the archive claims
    };

    static Result<Archive> open(const std::string& path);
    const std::string& path() const { return path_; }
    const std::vector<Member>& members() const { return members_; }
    /// Stored or deflated; `name` is for messages. What is deflated is slow to seek in.
    Result<std::unique_ptr<Bytes>> bytes(std::size_t member, std::string name) const;

private:
    std::vector<Member> members_;
};

struct Packed {
    std::string name, bytes;
};

/// The bytes of an archive that stores these, with no date: the same members, the same bytes.
Result<std::string> make_archive(const std::vector<Packed>&);

}  // namespace corpuscle
