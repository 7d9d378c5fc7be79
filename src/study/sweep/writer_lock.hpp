#pragma once
// Lock of a results file: only one process writes it. The lock is released when the process ends.

#include <cstdint>
#include <optional>
#include <string>

#include "signal/error.hpp"

namespace corpuscle {

/// A lock on path-writer, a file beside the results that names the writer, its start time, and the number of items finished then. (A lock
/// on the results file itself would interfere with SQLite.)
class WriterLock {
    std::string path_;
    int file_ = -1;

public:
    struct Writer {
        long process = 0;
        std::string host;
        double since = 0;                        ///< s, system clock
        std::int64_t finished = 0, planned = 0;  ///< items, at the start
    };

    WriterLock() = default;
    WriterLock(WriterLock&&) noexcept;
    WriterLock& operator=(WriterLock&&) noexcept;
    ~WriterLock();  ///< also removes the file

    /// Fails if another process has the lock, and names it.
    static Result<WriterLock> take(const std::string& results);
    /// Records the number of finished items at the start, and of items to run.
    void write_progress(std::int64_t finished, std::int64_t planned) const;
    /// The current owner of the lock, if any.
    static std::optional<Writer> holder(const std::string& results);
};

}  // namespace corpuscle
