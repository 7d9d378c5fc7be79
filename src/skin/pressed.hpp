#pragma once
// A sensor array under an indenter: what its sites stand for.

#include <string>

#include "skin/plan.hpp"

namespace corpuscle {

/// Under an indenter an array of sensors that says nothing of area is taken for skin: each site for a cell of its lattice, and what a unit
/// feels as `felt_area` has it in the built-in skins. Returns the sentence that says so; "": nothing was changed, because the plan says
/// what its sites stand for, or because they are on no lattice.
std::string take_for_skin(SkinPlan&);

/// m2: as the built-in skins have it.
inline constexpr double usual_felt_area = 1e-4;

}  // namespace corpuscle
