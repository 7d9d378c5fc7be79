#pragma once
// A warning about the noise of a sensor that is enough to make afferents fire.

#include <string>

#include "core/afferent_factory.hpp"
#include "core/force_source.hpp"

namespace corpuscle {

/// A class of afferents that is tested with the noise.
struct NoiseSubject {
    std::string name;  ///< for the message
    const AfferentPlan* plan = nullptr;
};

/// The warning, with a remedy, if white noise as large as that of the noisiest channel makes one of these afferents fire; otherwise "".
/// The noise is the metric "noise" of the source's quality(), which is complete after the source has been read. Netlists are not tested.
std::string sensor_noise_warning(const ForceSource&, std::span<const NoiseSubject>, const SimulationOptions&);

}  // namespace corpuscle
