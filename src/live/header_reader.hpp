#pragma once
// The first line of CSV frames, where it has names.

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "signal/error.hpp"

namespace corpuscle {

/// Of the names of a header, without the stamp's: at which place of a frame each of its numbers goes, nothing for their own order; or why
/// these names are refused.
using HeaderReader = std::function<Result<std::vector<std::uint32_t>>(std::span<const std::string> names)>;

}  // namespace corpuscle
