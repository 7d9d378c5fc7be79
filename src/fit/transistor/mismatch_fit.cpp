#include "fit/transistor/mismatch_fit.hpp"

#include <algorithm>
#include <cmath>

namespace corpuscle {
namespace {

/// The sums over all devices for a coefficient A.
struct Likelihood {
    double minus_log = 0;  // -2 log of the restricted likelihood: the mean is estimated, too
    double mean = 0, weights = 0;
    double mismatch = 0;     // variance of weights * mean by mismatch
    double information = 0;  // equivalent number of deviations without an error

    Likelihood(double A, const Vector& deviations, const Vector& errors, const Vector& areas) {
        const auto variance = [&](std::size_t k) { return A * A / areas[k] + errors[k] * errors[k]; };
        for (std::size_t k = 0; k < deviations.size(); ++k) weights += 1 / variance(k), mean += deviations[k] / variance(k);
        mean /= weights;
        for (std::size_t k = 0; k < deviations.size(); ++k) {
            const double v = variance(k), d = deviations[k] - mean, fraction = A * A / areas[k] / v;
            minus_log += num::log(v) + d * d / v, information += fraction * fraction, mismatch += fraction / v;
        }
        minus_log += num::log(weights);
    }
};

/// The quantile of chi squared over its number of degrees of freedom (Wilson and Hilferty 1931, PNAS 17:684). z: of the normal one.
double chi_squared_ratio(double degrees, double z) {
    const double part = 2 / (9 * degrees), root = 1 - part + z * std::sqrt(part);
    return root > 0 ? root * root * root : 0;
}

}  // namespace

PelgromCoefficient pelgrom_coefficient(const Vector& deviations, const Vector& errors, const Vector& areas) {
    double largest = 1e-30;
    for (std::size_t k = 0; k < deviations.size(); ++k)
        largest = std::max(largest, (std::abs(deviations[k]) + errors[k]) * std::sqrt(areas[k]));
    const auto cost = [&](double log_A) { return Likelihood(num::exp(log_A), deviations, errors, areas).minus_log; };
    constexpr double golden = 0.6180339887498949;
    double low = num::log(largest) - 12, high = num::log(largest) + 1;
    for (int pass = 0; pass < 60; ++pass) {
        const double x = high - golden * (high - low), y = low + golden * (high - low);
        (cost(x) < cost(y) ? high : low) = cost(x) < cost(y) ? y : x;
    }
    PelgromCoefficient out;
    out.value = num::exp((low + high) / 2);
    const Likelihood at(out.value, deviations, errors, areas);
    const double degrees = std::max(at.information - 1, 0.5);
    constexpr double z = 1.959964;
    out.low = out.value / std::sqrt(chi_squared_ratio(degrees, z));
    out.high = out.value / std::sqrt(std::max(chi_squared_ratio(degrees, -z), 1e-6));
    out.mean = at.mean, out.mean_half_width = student_quantile(degrees) * std::sqrt(at.mismatch) / at.weights;
    return out;
}

DeviceDeviations fit_deviations(const CurveResiduals& residuals, const circuit::UicmCard& card, std::size_t devices) {
    DeviceDeviations out;
    for (std::uint32_t d = 0; d < devices; ++d) {
        const auto fit =
            least_squares([&](const Vector& x, bool with_slopes) { return residuals.device_residuals(card, d, x, with_slopes); },
                          {residuals.shifts[d].V_T, residuals.shifts[d].log_I_S}, {-0.5, -2}, {0.5, 2});
        const auto c = covariance(fit.at.slopes, {false, false});
        out.V_T.push_back(fit.x[0]), out.log_I_S.push_back(fit.x[1]);
        out.V_T_error.push_back(std::sqrt(c[0])), out.log_I_S_error.push_back(std::sqrt(c[3]));
    }
    return out;
}

}  // namespace corpuscle
