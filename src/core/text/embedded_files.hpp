#pragma once
// Files embedded in the program when it was built: netlists, process cards, populations.

#include <string_view>
#include <vector>

#include "core/error.hpp"

namespace corpuscle {

/// The text of the embedded file with this path in the source tree: "circuits/bias.cir". An unknown path is an error.
Result<std::string> embedded_text(const std::string& path);

/// The paths of all embedded files, such as "process/tsmc180.lib".
std::vector<std::string_view> embedded_files();

}  // namespace corpuscle
