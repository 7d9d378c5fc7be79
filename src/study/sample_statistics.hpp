#pragma once
// Mean and standard deviation of a quantity over the chips that a .mc directive samples.

#include <vector>

#include "study/study_netlist.hpp"

namespace corpuscle {

struct SampleStatistics {
    std::vector<double> values;
    double mean = 0, standard_deviation = 0;  ///< sample standard deviation, over n - 1
    double cv_percent() const { return 100 * standard_deviation / mean; }
};
SampleStatistics sample_statistics(std::vector<double> values);

/// Statistics of a voltage or a current at each chip's operating point: "v(q)".
SampleStatistics sample_statistics(const std::vector<NetlistResult>& chips, const std::string& name);

}  // namespace corpuscle
