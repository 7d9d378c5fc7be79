#include "fit/transistor/least_squares.hpp"

#include <algorithm>
#include <cmath>

namespace corpuscle {
namespace {

constexpr int max_steps = 60, max_attempts = 12;
constexpr double least_eigenvalue = 1e-14;  // relative; below it rounding decides

/// The products of the slopes, scaled so that the diagonal is 1, in its eigensystem.
struct NormalEquations {
    Vector scale;  // 1 / length of the slopes; 0 for a coordinate that is fixed or has no effect
    Eigensystem eigen;

    NormalEquations(const std::vector<Vector>& slopes, const std::vector<bool>& is_fixed) {
        const auto n = slopes.size();
        for (std::size_t k = 0; k < n; ++k) {
            const double length = std::sqrt(dot_product(slopes[k], slopes[k]));
            scale.push_back(is_fixed[k] || !(length > 0) ? 0 : 1 / length);
        }
        Matrix products(n * n);
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j <= i; ++j)
                products[i * n + j] = products[j * n + i] = i == j ? 1
                                                            : scale[i] * scale[j] == 0
                                                                ? 0
                                                                : scale[i] * scale[j] * dot_product(slopes[i], slopes[j]);
        eigen = symmetric_eigensystem(std::move(products), n);
    }

    /// The step that minimises the linearized cost with a damping. `gradient`: half the derivative of the cost.
    Vector step(const Vector& gradient, double damping) const {
        const auto n = scale.size();
        Vector out(n);
        for (std::size_t j = 0; j < n; ++j) {
            double along = 0;
            for (std::size_t k = 0; k < n; ++k) along += eigen.vectors[j][k] * scale[k] * gradient[k];
            const double by = -along / (std::max(eigen.values[j], 0.0) + damping);
            for (std::size_t k = 0; k < n; ++k) out[k] += scale[k] * eigen.vectors[j][k] * by;
        }
        return out;
    }
};

Vector gradient_of(const SlopedResiduals& at) {
    Vector out;
    for (const auto& s : at.slopes) out.push_back(dot_product(s, at.values));
    return out;
}

/// The coordinates at a bound at which the cost falls outwards.
std::vector<bool> blocked(const Vector& x, const Vector& gradient, const Vector& low, const Vector& high) {
    std::vector<bool> out;
    for (std::size_t k = 0; k < x.size(); ++k) out.push_back((x[k] <= low[k] && gradient[k] > 0) || (x[k] >= high[k] && gradient[k] < 0));
    return out;
}

}  // namespace

LeastSquaresFit least_squares(const SlopedFunction& function, Vector x, const Vector& low, const Vector& high) {
    LeastSquaresFit fit;
    fit.x = std::move(x), fit.at = function(fit.x, true);
    fit.cost = dot_product(fit.at.values, fit.at.values);
    double damping = 1e-3;
    for (int pass = 0; pass < max_steps && !fit.is_converged; ++pass) {
        const auto gradient = gradient_of(fit.at);
        const NormalEquations equations(fit.at.slopes, blocked(fit.x, gradient, low, high));
        bool is_better = false;
        for (int attempt = 0; attempt < max_attempts && !is_better; ++attempt) {
            const auto step = equations.step(gradient, damping);
            auto next = fit.x;
            for (std::size_t k = 0; k < next.size(); ++k) next[k] = std::clamp(next[k] + step[k], low[k], high[k]);
            const auto values = function(next, false).values;
            const double cost = dot_product(values, values);
            is_better = cost < fit.cost;
            if (!is_better) {
                damping *= 10;
                continue;
            }
            damping = std::max(damping / 10, 1e-12);
            fit.is_converged = fit.cost - cost <= 1e-9 * fit.cost;
            fit.x = std::move(next), fit.cost = cost;
        }
        if (!is_better)
            fit.is_converged = true;  // no step is better: a minimum within rounding
        else
            fit.at = function(fit.x, true);
    }
    return fit;
}

Vector leverages(const std::vector<Vector>& slopes, const std::vector<bool>& is_fixed) {
    const auto c = covariance(slopes, is_fixed);
    const auto n = slopes.size();
    Vector out(n > 0 ? slopes[0].size() : 0);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
            if (const double c_ij = c[i * n + j]; c_ij < 1e299)  // a coordinate without effect has no slopes
                for (std::size_t k = 0; k < out.size(); ++k) out[k] += slopes[i][k] * c_ij * slopes[j][k];
    return out;
}

double student_quantile(double degrees) {
    constexpr double z = 1.959964, z3 = z * z * z, z5 = z3 * z * z;
    const double n = std::max(degrees, 1.5);
    return z + (z3 + z) / (4 * n) + (5 * z5 + 16 * z3 + 3 * z) / (96 * n * n);
}

Matrix covariance(const std::vector<Vector>& slopes, const std::vector<bool>& is_fixed) {
    const NormalEquations equations(slopes, is_fixed);
    const auto n = slopes.size();
    Matrix out(n * n);
    for (std::size_t j = 0; j < n; ++j) {
        const auto& v = equations.eigen.vectors[j];
        const double inverse = 1 / std::max(equations.eigen.values[j], least_eigenvalue);
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t k = 0; k < n; ++k) out[i * n + k] += equations.scale[i] * equations.scale[k] * v[i] * v[k] * inverse;
    }
    for (std::size_t k = 0; k < n; ++k)
        if (!is_fixed[k] && equations.scale[k] == 0) out[k * n + k] = 1e300;  // without effect
    return out;
}

}  // namespace corpuscle
