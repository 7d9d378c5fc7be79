#pragma once
// The area of skin that each site of a sensor array represents if the array is pressed with an indenter.

#include <string>

#include "skin/plan/skin_plan.hpp"

namespace corpuscle {

/// Prepares a plan for an indenter: a sensor array that defines no area of its sites is treated as skin. Each site then represents a cell
/// of the lattice of sites, and the plan gets the `felt_area` of the built-in skins. Returns a note that says so. If the plan defines the
/// area of its sites or a felt_area, or if the sites are not on a lattice, nothing is changed, and the result is "".
std::string treat_as_skin(SkinPlan&);

inline constexpr double default_felt_area = 1e-4;  ///< m2, as in the built-in skins

}  // namespace corpuscle
