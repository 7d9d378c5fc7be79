#pragma once
// All rows of a results file as text, in order of items. The text depends only on the sweep: not on shards, threads or runs.

#include "sweep/store/sweep_results.hpp"

namespace corpuscle {

/// CSV: a line of names, then one line for each item. The spike times of a train, and the samples of a probe, are one field, separated by
/// blanks. Numbers have the fewest digits that read back as the same value; NaN is an empty field. `put` receives pieces of text; false
/// stops.
Result<void> dump_results(const SweepResults&, const std::function<bool(const std::string&)>& put);

}  // namespace corpuscle
