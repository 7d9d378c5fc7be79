#pragma once
// The periods of a surface in the readings of taxels that slide over it.

#include "reproduction/texture/slide.hpp"

namespace corpuscle {

/// The frequency (Hz) between `from` and `to` with the largest power: the mean over the taxels, each scaled to deviation 1, with a Hann
/// window. Frequencies in steps of 0.05 Hz.
double strongest_frequency(const TaxelValues& counts, double from, double to);

}  // namespace corpuscle
