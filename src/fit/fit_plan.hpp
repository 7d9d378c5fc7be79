#pragma once

#include "core/afferent_factory.hpp"

namespace corpuscle {

/// Plans an afferent for a fit. Circuits are refused, because they are too slow.
Result<PlannedAfferent> plan_to_fit(const std::string& afferent, std::span<const ParameterOverride>);

}  // namespace corpuscle
