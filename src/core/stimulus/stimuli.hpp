#pragma once
// The built-in stimuli. Their list is in stimuli.cpp.

#include "core/parameter_override.hpp"
#include "core/stimulus/touch.hpp"
#include "core/stimulus/vibration.hpp"

namespace corpuscle {

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
