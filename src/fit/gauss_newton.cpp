#include "fit/gauss_newton.hpp"

#include <algorithm>
#include <cmath>

namespace corpuscle {
namespace {

double squared_distance(const Vector& a, const Vector& b) {
    double sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
    return sum;
}

/// The difference of the residuals between two points on both sides of a point, along one parameter.
struct CentralDifference {
    Vector above, below;
    double distance = 0;  ///< of the points, in the natural coordinate
    double effect = 0;    ///< of the step: the sum of the squared differences

    Vector slopes() const {
        Vector out(above.size());
        for (std::size_t i = 0; i < out.size(); ++i) out[i] = (above[i] - below[i]) / distance;
        return out;
    }
};

/// `step` in the natural coordinate.
Result<CentralDifference> central_difference(const ResidualFunction& residuals, const FreeParameter& parameter,
                                             std::span<const double> point, std::size_t k, double step) {
    Vector up(point.begin(), point.end()), down = up;
    up[k] = std::min(1.0, up[k] + step / parameter.width()), down[k] = std::max(0.0, down[k] - step / parameter.width());
    CentralDifference out;
    out.above = fitted_residuals(TRY(residuals(up))).values, out.below = fitted_residuals(TRY(residuals(down))).values;
    out.distance = (up[k] - down[k]) * parameter.width(), out.effect = squared_distance(out.above, out.below);
    return out;
}

/// The slopes of the residuals along a parameter, in its natural coordinate, over the largest step whose effect is not above `effect`. At
/// a point where a spike appears, the effect remains however small the step is, and the slopes would be almost infinite. There the step
/// is the smallest one whose effect is clearly above that of the spike.
Result<Vector> slopes_along(const ResidualFunction& residuals, const FreeParameter& parameter, std::span<const double> point, std::size_t k,
                            double effect) {
    constexpr double largest_step = 0.1, smallest_step = 1e-5, clearly = 16;
    double step = largest_step;
    for (; step >= smallest_step; step /= 2)
        if (const auto difference = central_difference(residuals, parameter, point, k, step); difference && difference->effect <= effect)
            return difference->slopes();
    auto last = TRY(central_difference(residuals, parameter, point, k, step));
    const double jump = last.effect;
    for (step *= 2; step <= largest_step; step *= 2) {
        auto difference = central_difference(residuals, parameter, point, k, step);
        if (!difference) break;
        last = std::move(*difference);
        if (last.effect > clearly * jump) break;
    }
    return last.slopes();
}

/// The step that minimises the linearized cost with a damping, in natural coordinates.
Vector damped_step(const Linearization& at, const Eigensystem& eigen, double damping) {
    Vector step(at.size());
    for (std::size_t j = 0; j < at.size(); ++j) {
        double along = 0;  // gradient along the eigenvector
        for (std::size_t k = 0; k < at.size(); ++k) along += eigen.vectors[j][k] * dot_product(at.slopes[k], at.residuals.values);
        for (std::size_t k = 0; k < at.size(); ++k) step[k] -= eigen.vectors[j][k] * along / (std::max(0.0, eigen.values[j]) + damping);
    }
    return step;
}

}  // namespace

FittedResiduals fitted_residuals(std::span<const ResidualBlock> all) {
    FittedResiduals out;
    for (const auto& b : all) {
        if (b.is_test) continue;
        out.values.insert(out.values.end(), b.residuals.begin(), b.residuals.end());
        out.block.insert(out.block.end(), b.residuals.size(), out.blocks++);
    }
    return out;
}

Result<Linearization> linearize(const ResidualFunction& residuals, std::span<const FreeParameter> parameters, std::span<const double> point,
                                double effect) {
    const std::size_t n = parameters.size();
    Linearization out{fitted_residuals(TRY(residuals(point))), {}, Matrix(n * n)};
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
        const double cost = dot_product(at->residuals.values, at->residuals.values);
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
