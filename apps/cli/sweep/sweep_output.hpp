#pragma once
// The progress of a sweep as text and JSON.

#include "cli/verb.hpp"
#include "sweep/stats/progress_status.hpp"

namespace corpuscle {

/// Prints the status as a table with the next command, or as JSON, unless --quiet was given.
void print_sweep_status(const CommonArguments&, const SweepStatus&);

}  // namespace corpuscle
