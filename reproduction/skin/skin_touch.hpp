#pragma once
// A touch of a skin by an indenter, for studies: the spikes of each afferent.

#include <memory>
#include <string>
#include <vector>

#include "skin/innervation.hpp"

namespace corpuscle {

/// A stimulus that presses an indenter on a skin.
struct SkinTouch {
    std::string stimulus = "ramp-hold", indenter = "sphere";
    std::vector<std::string> settings = {};  ///< of the stimulus and the contact: "ramp-hold.F_max=1", "contact.x=0"
    double rate = 1e3;                       ///< Hz, sampling rate
};

/// A built-in skin without conduction: spikes are recorded where they begin.
Result<std::shared_ptr<const Innervation>> skin_without_conduction(std::string_view name);

/// The spikes of one afferent, s since the first sample of the force.
using SpikeTimes = std::vector<double>;

/// The spike times of each afferent, in the order of Innervation::afferents.
Result<std::vector<SpikeTimes>> simulate_touch(const std::shared_ptr<const Innervation>&, const SkinTouch&);

/// Number of spikes in [from, to), s.
std::size_t spikes_between(const SpikeTimes&, double from, double to);

}  // namespace corpuscle
