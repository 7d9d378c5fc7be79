#pragma once
// How often a number is where, as steps to be drawn.

#include "study/line.hpp"

namespace corpuscle {

/// From the least to the largest value in `bins` equal parts; two pairs a part.
Line histogram_of(const std::vector<double>& values, int bins = 30);

}  // namespace corpuscle
