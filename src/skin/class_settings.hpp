#pragma once
// Parameters of a population's classes, as the user sets them.

#include <span>

#include "signal/settings.hpp"
#include "skin/plan.hpp"

namespace corpuscle {

/// "sa1.f_B=25Hz": all units of the class sa1 are drawn about it. Marks the wishes that name a class as used; refuses a parameter that the
/// class does not have, and a value out of its range.
Result<void> set_classes(SkinPlan&, std::span<const Wish>);

/// Refuses a wish that nothing has used: no class has this name, nor any of the other things that take part.
Result<void> check_all_used(const SkinPlan&, std::span<const Wish>, std::span<const std::string_view> others = {});

}  // namespace corpuscle
