#pragma once
// Output files. They are written under a temporary name and renamed when they are complete, so that no incomplete file remains. A file that
// grows slowly is the exception, because a part of it is useful.

#include <chrono>
#include <cstdio>
#include <string_view>
#include <vector>

#include "core/error.hpp"

namespace corpuscle {

/// Whether commit() synchronises a file to disk: always, or only if the file was created more than a second before. On a hard disk,
/// synchronising takes several times as long as a short run.
enum class SyncPolicy { if_slow, always };

class OutputFile {
    std::string path_;
    std::string temporary_path_;                    // "" after commit(), and for a device
    std::vector<std::string> created_directories_;  // directories created for this file, innermost first
    std::FILE* file_ = nullptr;                     // null after commit()
    std::size_t size_ = 0;                          // bytes written
    bool is_growing_ = false;                       // true: created by create_growing(), and not a device
    bool is_synced_ = false;                        // true: commit() synchronised the file to disk
    std::chrono::steady_clock::time_point start_time_ = std::chrono::steady_clock::now();

    static Result<OutputFile> prepare(const std::string& path);
    Error write_error() const;

public:
    OutputFile() = default;
    OutputFile(OutputFile&& other) noexcept;
    OutputFile& operator=(OutputFile&& other) noexcept;
    ~OutputFile();  ///< removes a file that was not committed, and the directories created for it

    /// Creates a file, and the missing directories of its path. A device or a named pipe is written in place.
    static Result<OutputFile> create(const std::string& path);
    /// Creates a file that other programs can read as path.part while it grows, because write() does not buffer. If this program is killed,
    /// path.part remains until the next run that writes this path. A second writer at the same time is an error. A device or a named pipe
    /// is written in place.
    static Result<OutputFile> create_growing(const std::string& path);
    /// Appends the text, or returns an error. After an error, a growing file is as it was before the call.
    Result<void> write(std::string_view text);
    /// Overwrites the bytes from position `at` on. Only for a growing file.
    Result<void> overwrite(std::size_t at, std::string_view text);
    std::size_t size() const { return size_; }  ///< bytes written
    /// Closes the complete file and renames it to its path. Returns an error if a byte could not be written. Synchronises the bytes of the
    /// file to disk first, if the policy says so. To synchronise the names of the files as well, call sync_directory_of() after the last
    /// file of a directory.
    Result<void> commit(SyncPolicy = SyncPolicy::if_slow);
    /// True if commit() synchronised the file to disk.
    bool is_synced() const { return is_synced_; }
    const std::string& path() const { return path_; }
    /// The open file, for a library that writes into it.
    std::FILE* stream() { return file_; }
};

/// Synchronises the directory of `path` to disk, so that the names of its files survive a power failure.
Result<void> sync_directory_of(const std::string& path);

/// Writes a complete file, which replaces an earlier one only when all its bytes are on the disk.
Result<void> replace_file(const std::string& path, std::string_view bytes);

}  // namespace corpuscle
