#pragma once
// The report page of a sweep: one self-contained HTML file. Plots and tables show a limited number
// of items, so its size does not grow with the number of work items.

#include <string>

#include "sweep/stats/sweep_summary.hpp"
#include "sweep/store/sweep_results.hpp"

namespace corpuscle {

Result<std::string> sweep_page(const SweepResults&, const SweepTable&, const SweepSummary&, const std::string& title,
                               const std::string& command);

}  // namespace corpuscle
