#pragma once
// Parameters that the user sets for the classes of a population.

#include <span>

#include "core/parameter_override.hpp"
#include "skin/plan/skin_plan.hpp"

namespace corpuscle {

/// Applies the overrides whose target is a class of the plan: "sa1.f_B=25Hz" sets the value around which f_B is sampled in the class sa1.
/// Marks these overrides as used. A parameter that the class does not have, and a value outside its range, are errors.
Result<void> apply_class_overrides(SkinPlan&, std::span<const ParameterOverride>);

/// Returns an error if an override has not been used, which means that its target is unknown. `others` are the targets besides the classes,
/// for the message.
Result<void> check_overrides_used(const SkinPlan&, std::span<const ParameterOverride>, std::span<const std::string_view> others = {});

}  // namespace corpuscle
