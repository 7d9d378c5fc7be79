#include "fit/transistor/noise_estimate.hpp"

#include <algorithm>
#include <cmath>

namespace corpuscle {
namespace {

constexpr double max_leverage = 0.9;
constexpr double least_relative = 1e-7, least_floor = 1e-19;  // -, A: below them rounding decides

}  // namespace

/// Fisher scoring of the variances a = relative^2 and b = floor^2: a weighted regression of the squared differences on I^2 and 1.
CurrentNoise estimate_noise(const Vector& differences, const Vector& currents, CurrentNoise start, std::optional<double> given_relative,
                            std::optional<double> given_floor, const Vector& leverages) {
    start.relative = given_relative.value_or(start.relative), start.floor = given_floor.value_or(start.floor);
    if (differences.empty() || (given_relative && given_floor)) return start;
    double a = start.relative * start.relative, b = start.floor * start.floor;
    for (int pass = 0; pass < 40; ++pass) {
        double aa = 0, ab = 0, bb = 0, ra = 0, rb = 0;
        for (std::size_t k = 0; k < differences.size(); ++k) {
            const double I2 = currents[k] * currents[k], variance = a * I2 + b;
            const double r2 = differences[k] * differences[k] / (1 - std::min(leverages[k], max_leverage)) / variance;
            const double by_a = I2 / variance, by_b = 1 / variance;
            aa += by_a * by_a, ab += by_a * by_b, bb += by_b * by_b, ra += by_a * r2, rb += by_b * r2;
        }
        const double old_a = a, old_b = b, determinant = aa * bb - ab * ab;
        if (given_floor) {
            a = (ra - ab * b) / aa;
        } else if (given_relative) {
            b = (rb - ab * a) / bb;
        } else if (determinant > 1e-12 * aa * bb) {
            a = (ra * bb - rb * ab) / determinant, b = (rb * aa - ra * ab) / determinant;
            if (a <= 0) a = 0, b = rb / bb;
            if (b <= 0) b = 0, a = ra / aa;
        } else {
            a = ra / aa, b = 0;
        }
        // Steps are limited, since a wrong weight makes the next step worse. A value below the least one becomes that.
        const auto limited = [](double value, double old, double least) {
            const double low = std::max(old / 30, least * least);
            return std::clamp(value, low, std::max(low, old * 30));
        };
        a = limited(a, old_a, least_relative);
        b = limited(b, old_b, least_floor);
        if (given_relative) a = old_a;
        if (given_floor) b = old_b;
        if (std::abs(a - old_a) <= 1e-4 * a && std::abs(b - old_b) <= 1e-4 * b) break;
    }
    return {std::sqrt(a), std::sqrt(b)};
}

double neighbour_correlation(const IvData& data, const Vector& residuals) {
    double product = 0, square = 0;
    for (const auto& c : data.curves)
        for (std::size_t k = c.begin; k < c.end; ++k) {
            square += residuals[k] * residuals[k];
            if (k + 1 < c.end) product += residuals[k] * residuals[k + 1];
        }
    return square > 0 ? std::clamp(product / square, 0.0, 0.98) : 0;
}

}  // namespace corpuscle
