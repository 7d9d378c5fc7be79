#pragma once
// Files are written beside their place and put there when they are whole: nothing half-written is left behind.

#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "signal/error.hpp"

namespace corpuscle {

class OutputFile {
    std::string path_, part_;
    std::vector<std::string> made_;  // directories that were not there before
    std::FILE* file_ = nullptr;

public:
    OutputFile() = default;
    OutputFile(OutputFile&& other) noexcept;
    OutputFile& operator=(OutputFile&& other) noexcept;
    ~OutputFile();  ///< removes what was not committed

    /// Makes the directories above it, too.
    static Result<OutputFile> create(const std::string& path);
    Result<void> write(std::string_view text);
    /// Puts the file in its place; refuses if a byte could not be written.
    Result<void> commit();
    const std::string& path() const { return path_; }
    /// For a library that writes into a file that is open.
    std::FILE* stream() { return file_; }
};

}  // namespace corpuscle
