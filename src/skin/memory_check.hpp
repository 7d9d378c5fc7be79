#pragma once
// Checks the memory that a skin needs before it is built.

#include <string_view>

#include "signal/error.hpp"

namespace corpuscle {

/// Refuses what exceeds the memory of this machine or the limit of this process (ulimit -v). `weights`: sites in the receptive fields of
/// all afferents together.
Result<void> check_available_memory(std::string_view name, double sites, double afferents, double weights);

}  // namespace corpuscle
