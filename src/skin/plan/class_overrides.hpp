#pragma once
// Parameters that the user sets for the classes of a population.

#include <span>

#include "core/parameter_override.hpp"
#include "skin/plan/skin_plan.hpp"

namespace corpuscle {

/// Applies the overrides whose target is a class of the plan: "sa1.f_B=25Hz" sets the value around which f_B is sampled in the class sa1.
/// A parameter that the class does not have, and a value outside its range, are errors.
Result<Applied<SkinPlan>> apply_overrides(SkinPlan, std::span<const ParameterOverride>);

/// The targets of overrides in a run of this skin: its classes, and `others`.
std::vector<std::string_view> override_targets(const SkinPlan&, std::vector<std::string_view> others = {});

}  // namespace corpuscle
