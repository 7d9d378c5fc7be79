#pragma once
// How much memory a skin takes, before it is made.

#include <string_view>

#include "signal/error.hpp"

namespace corpuscle {

/// Refuses what this machine, or the limit set for this process (ulimit -v), has no room for. `weights`: sites that a unit feels, of all
/// units together.
Result<void> check_memory(std::string_view name, double sites, double units, double weights);

}  // namespace corpuscle
