#pragma once
// The area that the sites of a sensor array represent under an indenter.

#include <string>

#include "skin/skin_plan.hpp"

namespace corpuscle {

/// Under an indenter a sensor array without area information is treated as skin. Each site represents a cell of its lattice, and afferents
/// respond as with the `felt_area` of the built-in skins. Returns a note about it. Returns "" if nothing was changed, because the plan
/// defines the area of its sites or they are not on a lattice.
std::string treat_as_skin(SkinPlan&);

inline constexpr double default_felt_area = 1e-4;  ///< m2, as in the built-in skins

}  // namespace corpuscle
