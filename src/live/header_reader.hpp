#pragma once
// Interprets the first line of CSV frames if it contains names.

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "signal/error.hpp"

namespace corpuscle {

/// Maps the names of a header (without the stamp's) to the positions of its numbers in a frame; an empty result keeps their order. Returns
/// an error if the names are refused.
using HeaderReader = std::function<Result<std::vector<std::uint32_t>>(std::span<const std::string> names)>;

}  // namespace corpuscle
