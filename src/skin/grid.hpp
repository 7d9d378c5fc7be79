#pragma once
// "grid 8x8": a sensor array as it comes, an SA-I and an FA-I at each site.

#include <optional>

#include "skin/plan.hpp"

namespace corpuscle {

/// Whether a text asks for a grid, "grid ..." or "grid:...".
bool is_grid(std::string_view text);

/// The plan of "grid 8x8", rows by columns.
Result<SkinPlan> plan_grid(std::string_view text);

}  // namespace corpuscle
