#pragma once
// Lock of a results file, so that only one process writes it. The lock is released when the process ends, also when it is killed.
//
// SQLite's own locks cannot do this. They are on the results file, which a checkpoint replaces by another; a lock for the whole run
// (locking_mode = EXCLUSIVE) would also keep readers out, such as --status; and they do not tell which process has the lock.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "io/output/descriptor.hpp"

namespace corpuscle {

/// A lock on RESULTS-writer, a file beside the results that contains a Writer. (A lock on the results file itself would interfere with
/// SQLite.)
class WriterLock {
    std::string path_;  // of the lock file
    Descriptor file_;

public:
    /// The process that has the lock. If it has not yet written the lock file, all members are 0 or empty.
    struct Writer {
        long process = 0;           ///< process id
        std::string host;           ///< name of its machine
        double since = 0;           ///< time of its last write_progress(), which is the start of its run: s since 1970
        std::int64_t finished = 0;  ///< items in the results at that time
        std::int64_t planned = 0;   ///< items that the run is to compute
    };

    /// `file`: the locked lock file.
    WriterLock(std::string path, Descriptor file) : path_(std::move(path)), file_(std::move(file)) {}
    ~WriterLock();  ///< also removes the lock file

    /// `results`: path of the results file. If another process has the lock, the error names that process.
    static Result<std::unique_ptr<WriterLock>> take(const std::string& results);
    /// Writes this process and these numbers, see Writer, to the lock file.
    void write_progress(std::int64_t finished, std::int64_t planned) const;
    /// The process that has the lock; no value if no process has it.
    static std::optional<Writer> holder(const std::string& results);
};

}  // namespace corpuscle
