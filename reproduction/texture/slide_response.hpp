#pragma once
// The spikes of afferents, one on each taxel of a sliding fingertip.

#include <functional>
#include <string>
#include <vector>

#include "reproduction/texture/slide.hpp"

namespace corpuscle {

/// Spike times (s) in each recording: [recording][taxel][spike].
using SlideSpikes = std::vector<std::vector<std::vector<double>>>;

/// The spikes of a model ("sa1").
Result<SlideSpikes> simulate_slides(const std::string& afferent, const std::vector<TaxelValues>& forces);

/// The spikes of the chips of a netlist ("sa1-circuit") in the first `duration` s of each recording, simulated on SIMD lanes. A chip that
/// does not converge is an error. `progress`: called with the finished fraction; must return false to stop.
Result<SlideSpikes> simulate_slides_with_chips(const std::string& chip, const std::vector<TaxelValues>& forces, double duration,
                                               const std::function<bool(double)>& progress);

}  // namespace corpuscle
