#include "fit/gauss_newton.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace corpuscle {
namespace {

using Matrix = std::vector<double>;  // n by n, row after row
using Vector = std::vector<double>;

/// The residuals that are fitted, and the number of the block of each.
struct FittedResiduals {
    Vector values;
    std::vector<std::size_t> block;
    std::size_t blocks = 0;
};

FittedResiduals fitted_residuals(std::span<const ResidualBlock> all) {
    FittedResiduals out;
    for (const auto& b : all) {
        if (b.is_test) continue;
        out.values.insert(out.values.end(), b.residuals.begin(), b.residuals.end());
        out.block.insert(out.block.end(), b.residuals.size(), out.blocks++);
    }
    return out;
}

double squared_distance(const Vector& a, const Vector& b) {
    double sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
    return sum;
}

/// The slopes of the residuals along a parameter, in its natural coordinate.
Result<Vector> slopes_along(const ResidualFunction& residuals, const FreeParameter& parameter, std::span<const double> point, std::size_t k,
                            double effect) {
    constexpr double largest_step = 0.1, smallest_step = 1e-5;
    for (double step = largest_step;; step /= 2) {
        Vector up(point.begin(), point.end()), down = up;
        up[k] = std::min(1.0, up[k] + step / parameter.width()), down[k] = std::max(0.0, down[k] - step / parameter.width());
        auto above = residuals(up), below = residuals(down);
        if ((!above || !below) && step / 2 < smallest_step) return above ? below.error() : above.error();
        if (!above || !below) continue;
        auto a = fitted_residuals(*above).values;
        const auto b = fitted_residuals(*below).values;
        if (squared_distance(a, b) > effect && step / 2 >= smallest_step) continue;
        const double distance = (up[k] - down[k]) * parameter.width();
        for (std::size_t i = 0; i < a.size(); ++i) a[i] = (a[i] - b[i]) / distance;
        return a;
    }
}

/// The step that minimises the linearized cost with a damping, in natural coordinates.
Vector damped_step(const Linearization& at, const Eigensystem& eigen, double damping) {
    Vector step(at.size());
    for (std::size_t j = 0; j < at.size(); ++j) {
        double along = 0;  // gradient along the eigenvector
        for (std::size_t k = 0; k < at.size(); ++k) along += eigen.vectors[j][k] * dot_product(at.slopes[k], at.residuals);
        for (std::size_t k = 0; k < at.size(); ++k) step[k] -= eigen.vectors[j][k] * along / (std::max(0.0, eigen.values[j]) + damping);
    }
    return step;
}

}  // namespace

Eigensystem symmetric_eigensystem(std::vector<double> a, std::size_t n) {
    Matrix v(n * n);
    for (std::size_t i = 0; i < n; ++i) v[i * n + i] = 1;
    for (int sweep = 0; sweep < 60; ++sweep) {
        double off = 0, scale = 0;
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < n; ++j) (i == j ? scale : off) += a[i * n + j] * a[i * n + j];
        if (!(off > 1e-30 * scale)) break;
        for (std::size_t p = 0; p < n; ++p)
            for (std::size_t q = p + 1; q < n; ++q) {
                if (a[p * n + q] == 0) continue;
                const double theta = (a[q * n + q] - a[p * n + p]) / (2 * a[p * n + q]);
                const double t = (theta >= 0 ? 1 : -1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
                const double c = 1 / std::sqrt(t * t + 1), s = t * c;
                for (std::size_t k = 0; k < n; ++k) {
                    const double x = a[k * n + p], y = a[k * n + q];
                    a[k * n + p] = c * x - s * y, a[k * n + q] = s * x + c * y;
                }
                for (std::size_t k = 0; k < n; ++k) {
                    const double x = a[p * n + k], y = a[q * n + k];
                    a[p * n + k] = c * x - s * y, a[q * n + k] = s * x + c * y;
                }
                for (std::size_t k = 0; k < n; ++k) {
                    const double x = v[k * n + p], y = v[k * n + q];
                    v[k * n + p] = c * x - s * y, v[k * n + q] = s * x + c * y;
                }
            }
    }
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t i, std::size_t j) { return std::pair(a[i * n + i], i) < std::pair(a[j * n + j], j); });
    Eigensystem out;
    for (const auto i : order) {
        out.values.push_back(a[i * n + i]);
        Vector vector;
        for (std::size_t k = 0; k < n; ++k) vector.push_back(v[k * n + i]);
        out.vectors.push_back(std::move(vector));
    }
    return out;
}

Vector fitted_values(std::span<const ResidualBlock> all) { return fitted_residuals(all).values; }

Result<Linearization> linearize(const ResidualFunction& residuals, std::span<const FreeParameter> parameters, std::span<const double> point,
                                double effect) {
    const std::size_t n = parameters.size();
    const auto at_point = TRY(residuals(point));
    auto fitted = fitted_residuals(at_point);
    Linearization out{std::move(fitted.values), std::move(fitted.block), fitted.blocks, {}, Matrix(n * n)};
    for (std::size_t k = 0; k < n; ++k) out.slopes.push_back(TRY(slopes_along(residuals, parameters[k], point, k, effect)));
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) out.JJ[i * n + j] = dot_product(out.slopes[i], out.slopes[j]);
    return out;
}

Vector gauss_newton(const ResidualFunction& residuals, std::span<const FreeParameter> parameters, Vector point, double effect,
                    const std::function<bool()>& should_continue) {
    constexpr int max_steps = 20;
    double damping = 1e-3;  // relative to the largest eigenvalue
    for (int pass = 0; pass < max_steps && should_continue(); ++pass) {
        const auto at = linearize(residuals, parameters, point, effect);
        if (!at) break;
        const double cost = dot_product(at->residuals, at->residuals);
        const auto eigen = symmetric_eigensystem(at->JJ, at->size());
        bool is_better = false;
        for (int attempt = 0; attempt < 6 && !is_better; ++attempt) {
            const auto step = damped_step(*at, eigen, damping * std::max(eigen.values.back(), 1e-300));
            auto next = point;
            for (std::size_t k = 0; k < next.size(); ++k) next[k] = std::clamp(next[k] + step[k] / parameters[k].width(), 0.0, 1.0);
            const auto there = residuals(next);
            is_better = there && cost_of(*there) < cost;
            damping = is_better ? damping / 10 : damping * 10;
            if (is_better) point = std::move(next);
        }
        if (!is_better) break;
    }
    return point;
}

}  // namespace corpuscle
