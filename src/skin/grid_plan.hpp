#pragma once
// "grid 8x8": a rectangular sensor array, with an SA-I and an FA-I at each site.

#include <optional>

#include "skin/skin_plan.hpp"

namespace corpuscle {

/// True if a text names a grid, "grid ..." or "grid:...".
bool is_grid_name(std::string_view text);

/// The plan of "grid 8x8", rows by columns.
Result<SkinPlan> plan_grid(std::string_view text);

}  // namespace corpuscle
