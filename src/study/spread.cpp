#include "study/spread.hpp"

#include <cmath>

namespace corpuscle {

SampleSpread spread_of(std::vector<double> values) {
    SampleSpread out;
    const auto n = static_cast<double>(values.size());
    for (const double x : values) out.mean += x / n;
    for (const double x : values) out.deviation += (x - out.mean) * (x - out.mean) / (n - 1);
    out.deviation = std::sqrt(out.deviation);
    out.values = std::move(values);
    return out;
}

SampleSpread spread_of(const std::vector<Found>& chips, const std::string& name) {
    std::vector<double> values;
    for (const auto& chip : chips) values.push_back(chip.at_rest(name));
    return spread_of(std::move(values));
}

}  // namespace corpuscle
