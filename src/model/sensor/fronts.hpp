#pragma once
// Builds from a plan the front end of an afferent or, with a converter, the complete digital afferent.

#include "model/catalog.hpp"
#include "model/sensor/digital.hpp"

namespace corpuscle {

Front front_of(const AfferentPlan&);

/// The fixed-point algorithms behind a plan's converter. Refuses models without a fixed-point version, and constants that do not fit a
/// word.
Result<std::unique_ptr<const FixedChain>> fixed_chain_of(const AfferentPlan&);

/// The afferent of a plan with a converter.
std::unique_ptr<Digital> make_digital(const AfferentPlan&, const Run&);

}  // namespace corpuscle
