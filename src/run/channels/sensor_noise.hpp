#pragma once
// A warning about the noise of a sensor that is enough to make afferents fire.

#include <span>
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
/// The noise is the metric "noise" of the quality, which names channels by their index in `channels`. `rate`: of the samples, Hz. Netlists
/// are not tested.
std::string sensor_noise_warning(std::span<const Channel> channels, const RecordingQuality&, double rate, std::span<const NoiseSubject>,
                                 const SimulationOptions&);
/// The same for a source, whose quality() is complete after it has been read.
std::string sensor_noise_warning(const ForceSource&, std::span<const NoiseSubject>, const SimulationOptions&);

}  // namespace corpuscle
