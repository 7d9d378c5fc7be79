#pragma once
// Mean and standard deviation of a quantity over the chips that a .mc directive samples.

#include <vector>

#include "reproduction/claims/study_netlist.hpp"

namespace corpuscle {

struct SampleStatistics {
    std::vector<double> values;               ///< one for each chip
    double mean = 0, standard_deviation = 0;  ///< sample standard deviation, over n - 1
    /// Coefficient of variation.
    double cv_percent() const { return 100 * standard_deviation / mean; }
};
/// Statistics of at least two values.
SampleStatistics sample_statistics(std::vector<double> values);

/// Statistics over the chips of a voltage or current at the operating point; `name` such as "v(q)".
SampleStatistics sample_statistics(const std::vector<NetlistResult>& chips, const std::string& name);

}  // namespace corpuscle
