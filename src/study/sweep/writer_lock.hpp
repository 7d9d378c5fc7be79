#pragma once
// Who writes a file of results: one process at a time. The lock dies with its process.

#include <cstdint>
#include <optional>
#include <string>

#include "signal/error.hpp"

namespace corpuscle {

/// Held on path-writer, a file beside the results that says who writes them, since when, and how many units had ended then. (A lock on
/// the results themselves would be in SQLite's way.)
class WriterLock {
    std::string path_;
    int file_ = -1;

public:
    struct Writer {
        long process = 0;
        std::string host;
        double since = 0;                      ///< s, of the system's clock
        std::int64_t finished = 0, to_do = 0;  ///< units, when it began
    };

    WriterLock() = default;
    WriterLock(WriterLock&&) noexcept;
    WriterLock& operator=(WriterLock&&) noexcept;
    ~WriterLock();  ///< and removes the file

    /// Refuses if another has it, and names that.
    static Result<WriterLock> take(const std::string& results);
    /// How many units had ended when this writer began, and how many it is to do.
    void note(std::int64_t finished, std::int64_t to_do) const;
    /// Who has it now, if anybody.
    static std::optional<Writer> holder(const std::string& results);
};

}  // namespace corpuscle
