#pragma once

#include <string>
#include <vector>

namespace corpuscle {

/// Removes from the directory what the summary.json of an earlier run there says it has written ("files") and this run does not
/// write; gives the names of what was removed. Only names of files in that very directory are taken.
std::vector<std::string> remove_stale(const std::string& directory, const std::vector<std::string>& written);

}  // namespace corpuscle
