#pragma once
// Builds the front end of a plan and, if it has a converter, the complete digital afferent.

#include "core/afferent_factory.hpp"
#include "model/sensor/digital_afferent.hpp"

namespace corpuscle {

/// The sensor and the transducer of a plan; without stages if it has none.
FrontEnd make_front_end(const AfferentPlan&);

/// The fixed-point algorithms behind a plan's converter. Models without a fixed-point version are an error, and so are constants that do
/// not fit a word.
Result<std::unique_ptr<const FixedChain>> make_fixed_chain(const AfferentPlan&);

/// The afferent of a plan with a converter. The plan must have passed check_plan().
std::unique_ptr<DigitalAfferent> make_digital(const AfferentPlan&, const SimulationOptions&);

}  // namespace corpuscle
