#pragma once
// Lock of a results file, so that only one process writes it. The lock is released when the process ends, also when it is killed.

#include <cstdint>
#include <optional>
#include <string>

#include "core/error.hpp"

namespace corpuscle {

/// A lock on RESULTS-writer, a file beside the results that contains a Writer. (A lock on the results file itself would interfere with
/// SQLite.)
class WriterLock {
    std::string path_;  // of the lock file
    int file_ = -1;     // its descriptor; -1: no lock

public:
    /// The process that has the lock. If it has not yet written the lock file, all members are 0 or empty.
    struct Writer {
        long process = 0;           ///< process id
        std::string host;           ///< name of its machine
        double since = 0;           ///< time of its last write_progress(), which is the start of its run: s since 1970
        std::int64_t finished = 0;  ///< items in the results at that time
        std::int64_t planned = 0;   ///< items that the run is to compute
    };

    WriterLock() = default;
    WriterLock(WriterLock&&) noexcept;
    WriterLock& operator=(WriterLock&&) noexcept;
    ~WriterLock();  ///< also removes the lock file

    /// `results`: path of the results file. If another process has the lock, the error names that process.
    static Result<WriterLock> take(const std::string& results);
    /// Writes this process and these numbers, see Writer, to the lock file.
    void write_progress(std::int64_t finished, std::int64_t planned) const;
    /// The process that has the lock; no value if no process has it.
    static std::optional<Writer> holder(const std::string& results);
};

}  // namespace corpuscle
