#include "reproduction/data/curve_functions.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace corpuscle {
namespace {

constexpr double absent = std::numeric_limits<double>::quiet_NaN();

std::ptrdiff_t turning_point(const StudyCurve& c) { return std::max_element(c.x.begin(), c.x.end()) - c.x.begin(); }

}  // namespace

StudyCurve moved_along_x(StudyCurve curve, double by_x) {
    for (double& x : curve.x) x += by_x;
    return curve;
}
StudyCurve moved(StudyCurve curve, double by_x, double by_y) {
    curve = moved_along_x(std::move(curve), by_x);
    for (double& y : curve.y) y += by_y;
    return curve;
}

StudyCurve composed(const StudyCurve& outer, const StudyCurve& inner) {
    StudyCurve out{inner.x, {}};
    for (const double y : inner.y) out.y.push_back(outer.at(y));
    return out;
}

StudyCurve over(const StudyCurve& curve, const StudyCurve& other) {
    StudyCurve out{composed(other, {curve.x, curve.x}).y, curve.y};
    if (out.x.size() > 1 && out.x.back() < out.x.front())
        std::reverse(out.x.begin(), out.x.end()), std::reverse(out.y.begin(), out.y.end());
    return out;
}

StudyCurve above(const StudyCurve& curve, double level) {
    StudyCurve out;
    for (std::size_t k = 0; k < curve.x.size(); ++k)
        if (curve.y[k] > level) out.x.push_back(curve.x[k]), out.y.push_back(curve.y[k]);
    return out;
}

StudyCurve rising_part(const StudyCurve& c) {
    const auto count = std::min<std::ptrdiff_t>(turning_point(c) + 1, std::ssize(c.x));
    return {{c.x.begin(), c.x.begin() + count}, {c.y.begin(), c.y.begin() + count}};
}
StudyCurve falling_part(const StudyCurve& c) {
    return {{c.x.rbegin(), c.x.rend() - turning_point(c)}, {c.y.rbegin(), c.y.rend() - turning_point(c)}};
}

StudyCurve decades(double from, double to, double points) {
    StudyCurve out;
    for (double x = from; x <= to; x *= std::pow(10, 1.0 / points)) out.x.push_back(x);
    return {out.x, out.x};
}
StudyCurve steps(double from, double to, double step) {
    StudyCurve out;
    for (double x = from; x <= to; x += step) out.x.push_back(x);
    return {out.x, out.x};
}

double largest(const StudyCurve& curve) {
    double out = 0;
    for (const double y : curve.y) out = std::max(out, std::abs(y));
    return out;
}

double largest_step(const StudyCurve& curve) {
    double out = 0;
    for (std::size_t k = 1; k < curve.y.size(); ++k) out = std::max(out, std::abs(curve.y[k] - curve.y[k - 1]));
    return out;
}

double is_rising(const StudyCurve& c) { return std::is_sorted(c.y.begin(), c.y.end()) ? 1 : 0; }
double is_falling(const StudyCurve& c) {
    return std::adjacent_find(c.y.begin(), c.y.end(), std::less_equal<double>()) == c.y.end() ? 1 : 0;
}

double range_above(const StudyCurve& curve, double level) {
    double from = absent, to = absent;
    for (std::size_t k = 0; k < curve.x.size(); ++k)
        if (curve.y[k] >= level) (std::isnan(from) ? from : to) = curve.x[k];
    return to - from;
}

double longest_time_above(const StudyCurve& c, double level) {
    double longest = 0, start = absent;
    for (std::size_t k = 0; k < c.x.size(); ++k) {
        if (c.y[k] < level)
            start = absent;
        else if (std::isnan(start))
            start = c.x[k];
        else
            longest = std::max(longest, c.x[k] - start);
    }
    return longest;
}

double first_x_below(const StudyCurve& c, double level) {
    for (std::size_t k = 0; k < c.x.size(); ++k)
        if (c.y[k] <= level) return c.x[k];
    return absent;
}
double last_x_below(const StudyCurve& c, double level) {
    for (std::size_t k = c.x.size(); k-- > 0;)
        if (c.y[k] <= level) return c.x[k];
    return absent;
}

double last_crossing(const StudyCurve& c, double level, double from) {
    auto k = static_cast<std::size_t>(std::find(c.x.begin(), c.x.end(), from) - c.x.begin());
    if (k == c.x.size()) return absent;
    while (k > 0 && c.y[k - 1] >= level) --k;
    return k == 0 ? c.x[0] : c.x[k - 1] + (c.x[k] - c.x[k - 1]) * (level - c.y[k - 1]) / (c.y[k] - c.y[k - 1]);
}

double flat_range(const StudyCurve& c, double middle) {
    if (c.empty()) return absent;
    const double y_there = c.at(middle);
    double from = c.x.front();
    for (std::size_t k = 0; k < c.x.size(); ++k) {
        if (std::abs(c.y[k] / y_there - 1) <= 0.05) continue;
        if (c.x[k] < middle) from = c.x[k];
        if (c.x[k] > middle) return (c.x[k] - from) / 2;
    }
    return (c.x.back() - from) / 2;
}

double integral_above(const StudyCurve& c, double level) {
    double out = 0;
    for (std::size_t k = 1; k < c.x.size(); ++k) out += (c.x[k] - c.x[k - 1]) * std::max((c.y[k] + c.y[k - 1]) / 2 - level, 0.0);
    return out;
}

double charge(const StudyCurve& current, const TimeWindow& window) {
    double out = 0;
    for (std::size_t k = 1; k < current.x.size(); ++k)
        if (current.x[k] >= window.from && current.x[k] < window.to) out += current.y[k] * (current.x[k] - current.x[k - 1]);
    return out;
}

double count_resets(const StudyCurve& u) {
    double out = 0;
    for (std::size_t k = 1; k < u.y.size(); ++k) out += u.y[k - 1] - u.y[k] > 0.1 * u.max();
    return out;
}

double min_jump_ratio(const StudyCurve& curve, const std::vector<double>& spikes, double duration) {
    double min_ratio = std::numeric_limits<double>::infinity();
    for (const double t : spikes)
        min_ratio = std::min(min_ratio, curve.between(t, t + duration).max() / curve.between(t - 2 * duration, t - duration / 2).max());
    return min_ratio;
}

std::vector<double> before(const std::vector<double>& train, double time) {
    return {train.begin(), std::lower_bound(train.begin(), train.end(), time)};
}

std::vector<double> intervals(const std::vector<double>& train) {
    std::vector<double> out;
    for (std::size_t k = 1; k < train.size(); ++k) out.push_back(train[k] - train[k - 1]);
    return out;
}

double element(const std::vector<double>& list, double index) {
    return index >= 0 && index < static_cast<double>(list.size()) ? list[static_cast<std::size_t>(index)] : absent;
}

}  // namespace corpuscle
