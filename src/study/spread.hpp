#pragma once
// Mean and standard deviation of a quantity over the chips of a .mc.

#include <vector>

#include "study/deck.hpp"

namespace corpuscle {

struct SampleSpread {
    std::vector<double> values;
    double mean = 0, deviation = 0;  ///< sample standard deviation, over n - 1
    double percent() const { return 100 * deviation / mean; }
};
SampleSpread spread_of(std::vector<double> values);

/// For a voltage or a current at each chip's operating point: "v(q)".
SampleSpread spread_of(const std::vector<Found>& chips, const std::string& name);

}  // namespace corpuscle
