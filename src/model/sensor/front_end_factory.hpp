#pragma once
// Builds from a plan the front end of an afferent or, with a converter, the complete digital afferent.

#include "model/catalog.hpp"
#include "model/sensor/digital_afferent.hpp"

namespace corpuscle {

FrontEnd make_front_end(const AfferentPlan&);

/// The fixed-point algorithms behind a plan's converter. Refuses models without a fixed-point version, and constants that do not fit a
/// word.
Result<std::unique_ptr<const FixedChain>> make_fixed_chain(const AfferentPlan&);

/// The afferent of a plan with a converter.
std::unique_ptr<DigitalAfferent> make_digital(const AfferentPlan&, const SimulationOptions&);

}  // namespace corpuscle
