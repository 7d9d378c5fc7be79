#pragma once
// Stimuli by name. A new one: its struct in stimulus/, and its name in the list.

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "signal/field.hpp"
#include "signal/settings.hpp"
#include "signal/source.hpp"
#include "signal/stimulus/touch.hpp"
#include "signal/stimulus/vibration.hpp"

namespace corpuscle {

template <class... S>
struct StimulusList {};
using Stimuli = StimulusList<Press, RampHold, Step, Sine, Chirp, Noise, Grating>;

/// Name, sentence and rows of each, in the list's order.
std::vector<Card> stimulus_cards();

/// The parts of a sum, "press+noise".
std::vector<std::string_view> stimulus_members(std::string_view text);

/// Whether the text reads as a stimulus or a sum of stimuli, "press", "press+noise".
bool is_stimulus(std::string_view text);

/// A stimulus or a sum of stimuli, sampled at `rate` (Hz). A sum is as long as its longest member; a
/// shorter one holds its last value. It keeps the phases
/// of the first member that has some, and what comes after them. Wishes name a member: "noise.F_sd=50mN".
Result<std::unique_ptr<Source>> make_stimulus(std::string_view text, std::span<const Wish> wishes, double rate, std::uint64_t seed);

}  // namespace corpuscle
