#pragma once
// Parameters that the user sets for the classes of a population.

#include <span>

#include "signal/parameter_override.hpp"
#include "skin/skin_plan.hpp"

namespace corpuscle {

/// "sa1.f_B=25Hz": sets the value about which the parameters of the class sa1 are sampled. Marks the overrides that name a class as used.
/// Refuses a parameter that the class does not have, and a value outside its range.
Result<void> apply_class_overrides(SkinPlan&, std::span<const ParameterOverride>);

/// Refuses an override that has not been used: neither a class nor any of the other settable things has its name.
Result<void> check_overrides_used(const SkinPlan&, std::span<const ParameterOverride>, std::span<const std::string_view> others = {});

}  // namespace corpuscle
