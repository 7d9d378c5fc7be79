#pragma once
// What a run has written, told.

#include <string>
#include <vector>

#include "io/output.hpp"

namespace corpuscle {

/// All of a file at once, and in its place.
Result<void> put_whole(OutputFile&, const std::string& text);

/// Of some paths, the names of those that stand in this very directory.
std::vector<std::string> names_in(const std::string& directory, const std::vector<std::string>& paths);

/// "Written: a, b" and what of an earlier run is gone; or that nothing was.
std::string told_of(const std::vector<std::string>& paths, const std::vector<std::string>& removed);

}  // namespace corpuscle
