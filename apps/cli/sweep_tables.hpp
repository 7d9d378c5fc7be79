#pragma once
// What a sweep's results say, as tables for people: yields first, then measures, then what they depend on.

#include <string>

#include "study/sweep/sweep_summary.hpp"

namespace corpuscle {

/// `quantiles`: they were asked for, and are shown with their intervals.
std::string sweep_tables(const SweepTable&, const SweepSummary&, const std::string& title, bool quantiles);

}  // namespace corpuscle
