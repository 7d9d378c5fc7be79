#pragma once
// psth.csv of a run with trials.

#include "run/sinks/file_sink.hpp"

namespace corpuscle {

/// `bin_width`: s.
Result<std::unique_ptr<FileSink>> make_trial_histogram_file(const OutputRequest&, double bin_width);

}  // namespace corpuscle
