#include "reproduction/claims/sample_statistics.hpp"

#include <cmath>

namespace corpuscle {

SampleStatistics sample_statistics(std::vector<double> values) {
    SampleStatistics out;
    const auto n = static_cast<double>(values.size());
    for (const double x : values) out.mean += x / n;
    for (const double x : values) out.standard_deviation += (x - out.mean) * (x - out.mean) / (n - 1);
    out.standard_deviation = std::sqrt(out.standard_deviation);
    out.values = std::move(values);
    return out;
}

SampleStatistics sample_statistics(const std::vector<NetlistResult>& chips, const std::string& name) {
    std::vector<double> values;
    for (const auto& chip : chips) values.push_back(chip.operating_point(name));
    return sample_statistics(std::move(values));
}

}  // namespace corpuscle
