#pragma once
// All rows of a results file as text, in order of items. The same sweep gives the same bytes, independent of shards.

#include "study/sweep/sweep_results.hpp"

namespace corpuscle {

/// CSV: a line of names, then one line for each item. A train's spike times and a probe's samples are separated by blanks. Numbers have the
/// fewest digits that read back as the same value; NaN is an empty field. `put` receives pieces of text; false stops.
Result<void> dump_results(const SweepResults&, const std::function<bool(const std::string&)>& put);

}  // namespace corpuscle
