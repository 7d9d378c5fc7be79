#pragma once
// A sweep's results as a page to look at: one HTML file, no network. As large as there are points on a screen, not as there are units.

#include <string>

#include "study/sweep/results.hpp"
#include "study/sweep/sweep_summary.hpp"

namespace corpuscle {

Result<std::string> sweep_page(const SweepResults&, const SweepTable&, const SweepSummary&, const std::string& title,
                               const std::string& command);

}  // namespace corpuscle
