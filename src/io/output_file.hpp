#pragma once
// Output files. They are written under a temporary name and renamed when complete, so no partial file remains. A slowly growing file
// is the exception, because a part of it is useful.

#include <chrono>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "signal/error.hpp"

namespace corpuscle {

/// When a file is synchronised to disk: always, or only if it took longer than a second to compute. On a hard disk, synchronising takes
/// several times as long as a short run.
enum class SyncPolicy { if_slow, always };

class OutputFile {
    std::string path_, temporary_path_;
    std::vector<std::string> created_directories_;  // created for this file
    std::FILE* file_ = nullptr;
    std::size_t size_ = 0;
    bool is_growing_ = false, is_synced_ = false;
    std::chrono::steady_clock::time_point start_time_ = std::chrono::steady_clock::now();

    static Result<OutputFile> prepare(const std::string& path);
    Error write_error() const;

public:
    OutputFile() = default;
    OutputFile(OutputFile&& other) noexcept;
    OutputFile& operator=(OutputFile&& other) noexcept;
    ~OutputFile();  ///< removes a file that was not committed

    /// Creates missing directories too. A device or a named pipe is written in place.
    static Result<OutputFile> create(const std::string& path);
    /// Creates a file that can be read while it grows, as path.part. Each write() reaches the disk at once, and path.part remains if
    /// the program is killed; the next program that writes this path replaces it. A second writer at the same time is an error. A
    /// device or a named pipe is written in place.
    static Result<OutputFile> create_growing(const std::string& path);
    /// Writes all of the text, or returns an error. After an error a growing file is unchanged.
    Result<void> write(std::string_view text);
    /// Overwrites bytes from position `at` on. Only for a growing file.
    Result<void> overwrite(std::size_t at, std::string_view text);
    std::size_t size() const { return size_; }  ///< bytes written
    /// Renames the complete file to its path. Returns an error if a byte could not be written. If the file took longer than a second,
    /// or with SyncPolicy::always, its bytes are synchronised to disk first. To synchronise the names of the files as well, call
    /// sync_directory_of() after the last file of a directory.
    Result<void> commit(SyncPolicy = SyncPolicy::if_slow);
    bool is_synced() const { return is_synced_; }
    const std::string& path() const { return path_; }
    /// The open file, for a library that writes into it.
    std::FILE* stream() { return file_; }
};

/// Synchronises the directory of `path` to disk, so that the names of its files survive a power failure.
Result<void> sync_directory_of(const std::string& path);

}  // namespace corpuscle
