#pragma once
// Files are written beside their place and put there when they are whole: nothing half-written is left behind, but for those that
// grow so slowly that half of one is worth having.

#include <chrono>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "signal/error.hpp"

namespace corpuscle {

/// The disk is not waited for where a file is quick to make again: for a disk that turns that takes several times as long as a short run.
enum class Sync { if_costly, always };

class OutputFile {
    std::string path_, part_;
    std::vector<std::string> made_;  // directories that were not there before
    std::FILE* file_ = nullptr;
    std::size_t size_ = 0;
    bool grows_ = false, synced_ = false;
    std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();

    static Result<OutputFile> prepare(const std::string& path);
    Error broken() const;

public:
    OutputFile() = default;
    OutputFile(OutputFile&& other) noexcept;
    OutputFile& operator=(OutputFile&& other) noexcept;
    ~OutputFile();  ///< removes what was not committed

    /// Makes the directories above it, too. A device or a named pipe is written in place.
    static Result<OutputFile> create(const std::string& path);
    /// One that can be read while it grows: every write() is on disk at once, and a killed program leaves it, as path.part. The next that
    /// writes this path takes that over; while one does, another is refused. A device or a named pipe is written in place.
    static Result<OutputFile> growing(const std::string& path);
    /// All of it, or an error; one that grows is then as it was before.
    Result<void> write(std::string_view text);
    /// Over what stands there; of one that grows.
    Result<void> rewrite(std::size_t at, std::string_view text);
    std::size_t size() const { return size_; }  ///< what was written
    /// Puts the file in its place; refuses if a byte could not be written. Of one that took longer than a second to make, or always, its
    /// bytes are on the disk before: behind the last of a directory sync_directory_of() keeps the names, too. Of others they are on the
    /// way.
    Result<void> commit(Sync = Sync::if_costly);
    bool is_synced() const { return synced_; }
    const std::string& path() const { return path_; }
    /// For a library that writes into a file that is open.
    std::FILE* stream() { return file_; }
};

/// Names in the directory of `path` outlast a power failure from now on.
Result<void> sync_directory_of(const std::string& path);

}  // namespace corpuscle
