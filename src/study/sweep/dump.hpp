#pragma once
// All rows of a file of results as text, in order of unit: the same bytes whoever made them, in however many shards.

#include "study/sweep/results.hpp"

namespace corpuscle {

/// CSV: a line of names, then a line a unit; of a train its times, of a trace its samples, with blanks between; numbers as short as they
/// can be and still read back the same; nothing for a number that is none. `put` gets pieces; false stops.
Result<void> dump_results(const SweepResults&, const std::function<bool(const std::string&)>& put);

}  // namespace corpuscle
