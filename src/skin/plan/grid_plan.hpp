#pragma once
// The population "grid 8x8": a rectangular sensor array, with an SA-I and an FA-I afferent at each site.

#include <optional>

#include "skin/plan/skin_plan.hpp"

namespace corpuscle {

/// True if a text begins as the name of a grid, "grid ..." or "grid:...", in upper or lower case.
bool is_grid_name(std::string_view text);

/// The plan of a grid such as "grid 8x8" (8 rows by 8 columns).
Result<SkinPlan> plan_grid(std::string_view text);

}  // namespace corpuscle
