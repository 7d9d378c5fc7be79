#pragma once
// From a plan to what stands before its neurons, or, behind a converter, to all of it.

#include "model/catalog.hpp"
#include "model/sensor/digital.hpp"

namespace corpuscle {

Front front_of(const AfferentPlan&);

/// The algorithms behind a plan's converter; refuses a model that has none in fixed point, and constants that fit no word.
Result<std::unique_ptr<const FixedChain>> fixed_chain_of(const AfferentPlan&);

/// The afferent of a plan with a converter.
std::unique_ptr<Digital> make_digital(const AfferentPlan&, const Run&);

}  // namespace corpuscle
