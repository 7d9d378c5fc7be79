#pragma once
// Checks the memory that a skin needs before it is built.

#include <string_view>

#include "signal/error.hpp"

namespace corpuscle {

/// Returns an error if a skin needs more memory than this machine has or this process may use (ulimit -v). `weights`: the total number of
/// sites in the receptive fields of all afferents.
Result<void> check_available_memory(std::string_view name, double sites, double afferents, double weights);

}  // namespace corpuscle
