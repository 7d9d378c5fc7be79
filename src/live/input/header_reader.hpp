#pragma once
// Interprets the header of CSV frames: a first line that contains names instead of numbers.

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace corpuscle {

/// For each name of a header, without that of the stamp, returns the index of the force in the frame to which the numbers of this column
/// belong. An empty result means that the columns are in the order of the frame. Names that are refused are an error.
using HeaderReader = std::function<Result<std::vector<std::uint32_t>>(std::span<const std::string> names)>;

}  // namespace corpuscle
