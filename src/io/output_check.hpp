#pragma once
// Which files a command may replace, asked before anything is computed: none that it reads, and of the others only what an earlier run
// wrote, unless --overwrite is given.

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "signal/error.hpp"

namespace corpuscle {

class OutputCheck {
    bool overwrite_;
    std::vector<std::string> outputs_;  // of this command, absolute

    Result<void> enter(const std::string& path);

public:
    /// Whether a file that begins so was written by this program.
    using Signature = bool (*)(std::string_view beginning);

    explicit OutputCheck(bool overwrite) : overwrite_(overwrite) {}

    /// An output that stands alone. What killed runs have left of it (path.part-PID) is removed.
    Result<void> file(const std::string& path, Signature);
    /// The same of one that grows as path.part.
    Result<void> growing_file(const std::string& path, Signature);
    /// Outputs in a directory, of which its summary.json has listed those of an earlier run. What killed runs have left there of any
    /// output is removed.
    Result<void> directory(const std::string& path, std::span<const std::string> names,
                           const std::function<bool(const std::string& name)>& is_listed, bool (*is_output)(std::string_view name),
                           Signature page);
};

/// The first bytes of a regular file, links followed; "" if it cannot be read.
std::string beginning_of(const std::string& path);

/// Removes what killed runs have left of this output: path.part-PID, of which no living process holds the lock.
void remove_dead_parts(const std::string& path);

}  // namespace corpuscle
