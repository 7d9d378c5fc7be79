#pragma once
// The noise of measured currents, estimated from the residuals.

#include "fit/transistor/curve_residuals.hpp"

namespace corpuscle {

/// The noise under which the differences between measured and computed currents are most likely. A part in `given` is kept. `leverages`: by
/// which fraction the fit has reduced the variance of each difference.
CurrentNoise estimate_noise(const Vector& differences, const Vector& currents, CurrentNoise start, std::optional<double> given_relative,
                            std::optional<double> given_floor, const Vector& leverages);

/// The correlation of neighbouring residuals of a curve, from 0 to 0.98. A model that cannot follow a curve has residuals near 1; they tell
/// less than independent ones, and intervals are wider by sqrt((1 + r) / (1 - r)).
double neighbour_correlation(const IvData&, const Vector& residuals);

}  // namespace corpuscle
