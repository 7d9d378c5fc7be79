#pragma once
// Checks the memory that a skin needs before it is built.

#include <string_view>

#include "core/error.hpp"

namespace corpuscle {

/// Returns an error if a skin needs more memory than this machine has or this process may use (ulimit -v). `sites`, `afferents` and
/// `weights` are (estimated) numbers; a weight is one site in the receptive field of one afferent.
Result<void> check_available_memory(std::string_view name, double sites, double afferents, double weights);

}  // namespace corpuscle
