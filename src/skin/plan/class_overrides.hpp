#pragma once
// Parameters that the user sets for the classes of a population.

#include <span>
#include <string>

#include "core/parameter_override.hpp"
#include "skin/plan/skin_plan.hpp"

namespace corpuscle {

/// Applies the overrides whose target is a class of the plan: "sa1.f_B=25Hz" sets the value around which f_B is sampled in the class sa1.
/// A parameter that the class does not have, and a value outside its range, are errors.
Result<Applied<SkinPlan>> apply_overrides(SkinPlan, std::span<const ParameterOverride>);

/// The targets of overrides in a run of this skin: its classes, and `others`.
std::vector<std::string_view> override_targets(const SkinPlan&, std::vector<std::string_view> others = {});

/// Prepares a plan for an indenter: a sensor array that defines no area of its sites is treated as skin. Each site then represents a cell
/// of the lattice of sites, and the plan gets the `felt_area` of the built-in skins. Returns a note that says so. If the plan defines the
/// area of its sites or a felt_area, or if the sites are not on a lattice, nothing is changed, and the result is "".
std::string treat_as_skin(SkinPlan&);

inline constexpr double default_felt_area = 1e-4;  ///< m2, as in the built-in skins

}  // namespace corpuscle
