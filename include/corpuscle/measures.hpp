#pragma once
// Numbers from spike trains.

#include <span>
#include <string>
#include <vector>

#include "corpuscle/error.hpp"

namespace corpuscle {

/// The instantaneous frequencies of a train (spike times in s), in Hz: one at each spike except the last one, 1 / (t[k + 1] - t[k]), as in
/// section 3.3 of the thesis.
CORPUSCLE_API std::vector<double> instantaneous_rates(std::span<const double> train);

/// A measure of a spike train.
struct MeasureDescription {
    std::string name, unit, description;  ///< "peak_rate", "Hz", ...
};
/// All measures.
CORPUSCLE_API std::vector<MeasureDescription> measure_catalogue();
/// All measures of a train (spike times in s) in the window [from, to) in s, in the order of the catalogue; NaN if one is undefined.
CORPUSCLE_API std::vector<double> measure_train(std::span<const double> train, double from, double to);

}  // namespace corpuscle
