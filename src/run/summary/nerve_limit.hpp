#pragma once
// The highest firing rate of a nerve fibre, and a warning for afferents that exceed it.

#include <string>

#include "model/catalog.hpp"

namespace corpuscle {

/// The highest firing rate of a nerve fibre, Hz. The absolute refractory period is about 1 ms (Hodgkin & Huxley 1952, J Physiol 117:500).
inline constexpr double max_nerve_rate = 1e3;

/// The warning "spikes come at up to 4.5 MHz ...", with advice. `rate`: the highest firing rate of the afferent, Hz. `name`: its name for
/// --set.
std::string excessive_rate_warning(double rate, const AfferentPlan&, const std::string& name);

}  // namespace corpuscle
