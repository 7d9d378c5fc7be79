#pragma once
// Checks, before anything is computed, whether a command may write its outputs. A command never replaces its inputs. Without --overwrite it
// replaces only files that an earlier run wrote, and empty files.

#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "core/error.hpp"

namespace corpuscle {

/// The check of one command. Each function returns an error if an output would replace an input, another output, or a file that it may not
/// replace.
class OutputCheck {
    bool overwrite_;                    // true: --overwrite was given
    std::vector<std::string> outputs_;  // absolute paths of this command's outputs

    Result<void> add_output(const std::string& path);

public:
    /// A function that returns true if a file that begins with these bytes was written by this program.
    using Signature = bool (*)(std::string_view beginning);

    explicit OutputCheck(bool overwrite) : overwrite_(overwrite) {}

    /// Checks a single output file. Removes the temporary files (path.part-PID) that killed runs have left.
    Result<void> check_file(const std::string& path, Signature is_ours);
    /// Checks a single output file that is written as path.part while it grows.
    Result<void> check_growing_file(const std::string& path, Signature is_ours);
    /// Checks the output files `names` in the directory `path`. `is_listed` is true for a file that the summary.json of an earlier run
    /// lists; `is_output` is true for every name that an output can have; `page` recognises report pages by their beginning. Removes the
    /// temporary files that killed runs have left.
    Result<void> check_directory(const std::string& path, std::span<const std::string> names,
                                 const std::function<bool(const std::string& name)>& is_listed, bool (*is_output)(std::string_view name),
                                 Signature page);
};

/// True if the open file with this descriptor is still the file at this path: another process may have removed or replaced it.
bool is_file_at(int file, const std::string& path);

/// Removes the temporary files of the output `path` that killed runs have left: each path.part-PID that no process has locked.
void remove_stale_parts(const std::string& path);

}  // namespace corpuscle
