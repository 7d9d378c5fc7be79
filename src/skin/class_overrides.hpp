#pragma once
// Parameters that the user sets for the classes of a population.

#include <span>

#include "signal/parameter_override.hpp"
#include "skin/skin_plan.hpp"

namespace corpuscle {

/// Applies overrides of classes: "sa1.f_B=25Hz" sets the value around which f_B is sampled in the class sa1. Marks these overrides as used.
/// Refuses a parameter that the class does not have, and a value outside its range.
Result<void> apply_class_overrides(SkinPlan&, std::span<const ParameterOverride>);

/// Refuses an override that has not been used: its target is neither a class nor one of `others`, the other names that can be set.
Result<void> check_overrides_used(const SkinPlan&, std::span<const ParameterOverride>, std::span<const std::string_view> others = {});

}  // namespace corpuscle
