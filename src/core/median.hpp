#pragma once
// The median.

#include <span>

namespace corpuscle {

/// The median of numbers that are not NaN: the mean of the two middle ones if their number is even; NaN if there are none. Reorders them.
double median_of(std::span<double> values);

}  // namespace corpuscle
