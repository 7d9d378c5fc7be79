#pragma once
// The built-in stimuli. To add one, put its struct into stimulus/ and its name into the list below.

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "signal/force_source.hpp"
#include "signal/parameter.hpp"
#include "signal/parameter_override.hpp"
#include "signal/stimulus/touch.hpp"
#include "signal/stimulus/vibration.hpp"

namespace corpuscle {

template <class... S>
struct StimulusList {};
using Stimuli = StimulusList<Press, RampHold, Step, Sine, Chirp, Noise, Grating>;

/// Name, description and parameters of each stimulus, in the order of the list.
std::vector<CatalogEntry> stimulus_catalog();

/// The member names of a sum such as "press+noise".
std::vector<std::string_view> stimulus_members(std::string_view text);

/// True if the text names a stimulus or a sum of stimuli: "press", "press+noise".
bool is_stimulus(std::string_view text);

/// A stimulus or a sum of stimuli, sampled at `rate` (Hz). A sum is as long as its longest member, and a shorter member holds its last
/// value. The phases are those of the first member that has phases, followed by one phase "after" if the sum is longer. An override
/// names a member: "noise.F_sd=50mN".
Result<std::unique_ptr<ForceSource>> make_stimulus(std::string_view text, std::span<const ParameterOverride> overrides, double rate,
                                                   std::uint64_t seed);

}  // namespace corpuscle
