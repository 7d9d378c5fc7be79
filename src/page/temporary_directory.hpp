#pragma once
// A new directory for files, which the destructor removes with them.

#include <cstdlib>
#include <filesystem>
#include <utility>

#include "core/error.hpp"

namespace corpuscle::page {

class TemporaryDirectory {
    std::filesystem::path path_;  // empty: moved from

    explicit TemporaryDirectory(std::filesystem::path path) : path_(std::move(path)) {}

public:
    static Result<TemporaryDirectory> make() {
        std::error_code status;
        auto pattern = (std::filesystem::temp_directory_path(status) / "corpuscle-page-XXXXXX").string();
        if (status || !::mkdtemp(pattern.data())) return bad_input("a temporary directory cannot be created");
        return TemporaryDirectory(pattern);
    }
    TemporaryDirectory(TemporaryDirectory&& other) noexcept : path_(std::exchange(other.path_, {})) {}
    TemporaryDirectory& operator=(TemporaryDirectory&&) = delete;
    ~TemporaryDirectory() {
        std::error_code ignored;
        if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
    }
    std::string file(const std::string& name) const { return (path_ / name).string(); }
};

}  // namespace corpuscle::page
