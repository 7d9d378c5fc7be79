#include "reproduction/claims/study_curve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace corpuscle {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

}  // namespace

double StudyCurve::at(double at_x) const {
    if (empty() || !(at_x >= x.front() && at_x <= x.back())) return none;
    const auto after = std::lower_bound(x.begin(), x.end(), at_x);
    const auto k = static_cast<std::size_t>(after - x.begin());
    if (x[k] == at_x) return y[k];
    return y[k - 1] + (y[k] - y[k - 1]) * (at_x - x[k - 1]) / (x[k] - x[k - 1]);
}

double StudyCurve::crossing(double level, double from) const {
    for (std::size_t k = 0; k < x.size(); ++k) {
        if (x[k] < from) continue;
        if (y[k] == level) return x[k];
        if (k + 1 < x.size() && (y[k] - level) * (y[k + 1] - level) < 0)
            return x[k] + (x[k + 1] - x[k]) * (level - y[k]) / (y[k + 1] - y[k]);
    }
    return none;
}

StudyCurve StudyCurve::slope() const {
    StudyCurve out;
    for (std::size_t k = 1; k + 1 < x.size(); ++k) {
        const double before = x[k] - x[k - 1], after = x[k + 1] - x[k];
        const double left = (y[k] - y[k - 1]) / before, right = (y[k + 1] - y[k]) / after;
        out.x.push_back(x[k]), out.y.push_back((left * after + right * before) / (before + after));
    }
    return out;
}

StudyCurve StudyCurve::scaled(double x_factor, double y_factor) const {
    StudyCurve out = *this;
    for (double& v : out.x) v *= x_factor;
    for (double& v : out.y) v *= y_factor;
    return out;
}

StudyCurve StudyCurve::absolute() const {
    StudyCurve out = *this;
    for (double& v : out.y) v = std::abs(v);
    return out;
}

StudyCurve StudyCurve::inverse() const {
    StudyCurve out = *this;
    for (double& v : out.y) v = 1 / v;
    return out;
}

StudyCurve StudyCurve::between(double from, double to) const {
    StudyCurve out;
    for (std::size_t k = 0; k < x.size(); ++k)
        if (x[k] >= from && x[k] <= to) out.x.push_back(x[k]), out.y.push_back(y[k]);
    return out;
}

StudyCurve StudyCurve::resampled(double step) const {
    StudyCurve out;
    for (std::size_t k = 0; !empty() && x[0] + static_cast<double>(k) * step <= x.back(); ++k) {
        out.x.push_back(x[0] + static_cast<double>(k) * step);
        out.y.push_back(at(out.x.back()));
    }
    return out;
}

double StudyCurve::min() const { return empty() ? none : *std::min_element(y.begin(), y.end()); }
double StudyCurve::max() const { return empty() ? none : *std::max_element(y.begin(), y.end()); }

double StudyCurve::x_of_max() const {
    return empty() ? none : x[static_cast<std::size_t>(std::max_element(y.begin(), y.end()) - y.begin())];
}

StudyCurve::LineFit StudyCurve::fit_line() const {
    const auto n = static_cast<double>(x.size());
    double mean_x = 0, mean_y = 0, product = 0, square = 0;
    for (std::size_t k = 0; k < x.size(); ++k) mean_x += x[k] / n, mean_y += y[k] / n;
    for (std::size_t k = 0; k < x.size(); ++k) product += (x[k] - mean_x) * (y[k] - mean_y), square += (x[k] - mean_x) * (x[k] - mean_x);
    LineFit out{mean_y - product / square * mean_x, product / square, 0};
    for (std::size_t k = 0; k < x.size(); ++k)
        out.max_deviation = std::max(out.max_deviation, std::abs(y[k] - out.intercept - out.slope * x[k]));
    return out;
}

}  // namespace corpuscle
