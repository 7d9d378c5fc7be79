#pragma once
// How a number is spread over the chips of a .mc.

#include <vector>

#include "study/deck.hpp"

namespace corpuscle {

struct SampleSpread {
    std::vector<double> values;
    double mean = 0, deviation = 0;  ///< the deviation of a sample: n - 1
    double percent() const { return 100 * deviation / mean; }
};
SampleSpread spread_of(std::vector<double> values);

/// Of a voltage or a current at each chip's operating point: "v(q)".
SampleSpread spread_of(const std::vector<Found>& chips, const std::string& name);

}  // namespace corpuscle
