#pragma once
// The histogram of a list of numbers, for plots.

#include "reproduction/claims/study_curve.hpp"

namespace corpuscle {

/// Divides the range from the smallest to the largest value into `bins` equal parts. Each pair of the curve is the centre of a bin and the
/// number of values in it.
StudyCurve histogram_of(const std::vector<double>& values, int bins = 30);

}  // namespace corpuscle
