#include "optimize/problem.hpp"

#include <algorithm>
#include <cmath>

#include "core/number/elementary.hpp"

namespace corpuscle::optimize {

double DesignVariable::value(double position) const {
    const double p = std::clamp(position, 0.0, 1.0);
    const double x = p == 0 ? min : p == 1 ? max : is_logarithmic ? min * num::exp(p * num::log(max / min)) : min + p * (max - min);
    return is_integer ? std::clamp(std::round(x), min, max) : x;
}

double DesignVariable::position(double value) const {
    if (min == max) return 0;
    const double p = is_logarithmic ? num::log(value / min) / num::log(max / min) : (value - min) / (max - min);
    return std::clamp(p, 0.0, 1.0);
}

std::vector<double> OptimizationProblem::start() const {
    std::vector<double> out;
    for (const auto& v : variables) out.push_back(v.start);
    return out;
}

std::vector<double> OptimizationProblem::axis_values(std::span<const double> design, const DesignCase& at) const {
    std::vector<double> out;
    for (std::size_t k = 0; k < variables.size(); ++k) out.insert(out.end(), variables[k].names.size(), design[k]);
    out.insert(out.end(), at.values.begin(), at.values.end());
    return out;
}

}  // namespace corpuscle::optimize
