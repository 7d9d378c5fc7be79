#pragma once
// The results of a sweep as text.

#include "sweep/stats/sweep_summary.hpp"

namespace corpuscle {

/// The results of a sweep as tables: yields, measures, then the parameters on which they depend.
/// `quantiles`: also a table of the requested quantiles with their confidence intervals.
std::string sweep_tables(const SweepTable&, const SweepSummary&, const std::string& title, bool quantiles);

}  // namespace corpuscle
