#pragma once
// How often a number is where, to be drawn.

#include "study/line.hpp"

namespace corpuscle {

/// From the least to the largest value in `bins` equal parts; a pair is a part's middle and how many values are in it.
Line histogram_of(const std::vector<double>& values, int bins = 30);

}  // namespace corpuscle
