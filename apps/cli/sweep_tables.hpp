#pragma once
// Prints the results of a sweep as tables: yields, measures, then what they depend on.

#include <string>

#include "study/sweep/sweep_summary.hpp"

namespace corpuscle {

/// `quantiles`: print the requested quantiles with their confidence intervals.
std::string sweep_tables(const SweepTable&, const SweepSummary&, const std::string& title, bool quantiles);

}  // namespace corpuscle
