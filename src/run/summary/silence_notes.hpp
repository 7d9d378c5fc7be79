#pragma once
// Notes about afferents that never fired, with the factor by which the same force must be multiplied to make them fire.

#include <optional>
#include <string>

#include "core/afferent_factory.hpp"

namespace corpuscle {

/// Largest number of force samples of an input, summed over the rows of RunBlock::force, that are kept for the search of the factor. Later
/// samples are ignored.
inline constexpr std::size_t max_silence_samples = std::size_t{1} << 18;

/// A class of the population, none of whose afferents fired on any input.
struct SilentClass {
    std::size_t class_index = 0;   ///< see Population::class_of()
    double max_force = 0;          ///< N, the largest force on any channel of any input; in a skin see SilenceDetector
    std::optional<double> factor;  ///< see factor_to_fire(); for copies, of the first copy
};

/// A text such as "try fa1-nerve, which is calibrated to recordings of nerves", if there is such an afferent and the plan is of
/// another one; otherwise "".
std::string nerve_advice(const AfferentPlan&);

/// A note about a class of single afferents, such as "fa1 never fired: the largest force was 0.5 N; it would fire at about 6.3 times this
/// force", then nerve_advice() if there is any.
std::string silence_note(const AfferentPlan&, const SilentClass&);

}  // namespace corpuscle
