#pragma once
// The files that the program carries with it, as they were when it was built (cmake/carried.cmake): netlists, cards, populations.

#include <string>
#include <string_view>
#include <vector>

#include "signal/error.hpp"

namespace corpuscle {

/// The text of one of them, by its path: "circuits/bias.cir".
Result<std::string> carried_text(const std::string& path);

/// Their paths: "process/tsmc180.lib".
std::vector<std::string_view> carried_files();

}  // namespace corpuscle
