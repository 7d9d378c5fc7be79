#pragma once
// Runs one live stream: opens its input, skin and output, simulates, and prints a summary.

#include "cli/stream/stream_arguments.hpp"
#include "cli/verb.hpp"

namespace corpuscle {

/// Runs the stream until its input ends. If it is interrupted, which is an error, the summary has been printed.
Result<void> run_live(const StreamArguments&, const CommonArguments&);

}  // namespace corpuscle
