#pragma once
// Checks, before anything is computed, which files a command may replace. It never replaces its inputs. Without --overwrite it
// replaces only files that an earlier run wrote.

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "signal/error.hpp"

namespace corpuscle {

class OutputCheck {
    bool overwrite_;
    std::vector<std::string> outputs_;  // absolute paths of this command's outputs

    Result<void> add_output(const std::string& path);

public:
    /// Returns true if a file with this beginning was written by this program.
    using Signature = bool (*)(std::string_view beginning);

    explicit OutputCheck(bool overwrite) : overwrite_(overwrite) {}

    /// A single output file. Removes temporary files (path.part-PID) of runs that were killed.
    Result<void> check_file(const std::string& path, Signature);
    /// A single output file that is written as path.part while it grows.
    Result<void> check_growing_file(const std::string& path, Signature);
    /// Outputs in a directory: the files `names`. `is_listed` is true for files of an earlier run, which its summary.json lists;
    /// `is_output` is true for every name that an output can have; `page` recognises report pages. Removes temporary files of runs that
    /// were killed.
    Result<void> check_directory(const std::string& path, std::span<const std::string> names,
                                 const std::function<bool(const std::string& name)>& is_listed, bool (*is_output)(std::string_view name),
                                 Signature page);
};

/// The first bytes of a regular file, following links. "" if it cannot be read.
std::string read_beginning(const std::string& path);

/// Removes temporary files of this output that killed runs have left: each path.part-PID that no process has locked.
void remove_stale_parts(const std::string& path);

}  // namespace corpuscle
