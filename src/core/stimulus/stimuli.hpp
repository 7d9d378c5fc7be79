#pragma once
// The built-in stimuli. To add one, put its struct into stimulus/ and its name into the list below. The struct has a name, a description, a
// source, a struct Params with defaults, a table `fields` of ParameterDef, and a member `p` of type Params.
//
// duration() is its length in s, and at(t) the force in N at t s from its start. A stimulus may have phases(), its phases; a periodic one
// has cycle(), its frequency in Hz; a random one has a member `seed`.

#include "core/parameter_override.hpp"
#include "core/stimulus/touch.hpp"
#include "core/stimulus/vibration.hpp"

namespace corpuscle {

template <class... S>
struct StimulusList {};
using Stimuli = StimulusList<Press, RampHold, Step, Sine, Chirp, Noise, Grating>;

/// Name, description and parameters of each stimulus, in the order of the list.
std::vector<CatalogEntry> stimulus_catalog();

/// The names of the members of a sum such as "press+noise", in its order.
std::vector<std::string_view> stimulus_members(std::string_view text);

/// True if the text names a stimulus or a sum of stimuli: "press", "press+noise".
bool is_stimulus(std::string_view text);

/// A stimulus or a sum of stimuli, sampled at `rate` (Hz). `seed` determines its random numbers. A sum is as long as its longest member,
/// and a shorter member holds its last value. The phases are those of the first member that has phases; if the sum is longer, a phase
/// "after" follows. The target of an override is a member: "noise.F_sd=50mN".
Result<Applied<std::unique_ptr<ForceSource>>> make_stimulus(std::string_view text, std::span<const ParameterOverride> overrides,
                                                            double rate, std::uint64_t seed);
Result<std::unique_ptr<ForceSource>> make_stimulus(std::string_view text, double rate, std::uint64_t seed);

}  // namespace corpuscle
