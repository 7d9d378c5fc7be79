#pragma once
// Whether an afferent fires, and the factor by which its force must be multiplied to make it fire.

#include <optional>
#include <span>
#include <string>

#include "core/afferent_factory.hpp"

namespace corpuscle {

/// True if the afferent fires at least once under `force` (N). False after an error.
bool fires(const AfferentPlan&, const SimulationOptions&, std::span<const double> force);

/// The smallest factor, at least 1, by which `force` (N) must be multiplied for the afferent to fire; the result is at most 2 %
/// larger. No value if the factor exceeds a million.
std::optional<double> factor_to_fire(const AfferentPlan&, const SimulationOptions&, std::span<const double> force);

/// A number with two significant digits, rounded up: "1.5", "0.0021".
std::string format_rounded_up(double);

}  // namespace corpuscle
