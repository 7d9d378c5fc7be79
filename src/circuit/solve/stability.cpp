#include "circuit/solve/stability.hpp"

#include <algorithm>
#include <cmath>

namespace corpuscle::circuit {
namespace {

/// A disturbance v exp(lambda t) obeys (G + lambda C) v = 0; under M = (G + a C)^-1 (a C - G) it becomes v (a + lambda) / (a - lambda),
/// which is longer than v where it grows, and longest for a near |lambda|: so repeated M finds it, decade by decade.
class Disturbance {
    const System& system_;
    std::span<const double> G_, C_;
    std::vector<double> sum_, v_, next_;
    double ratio_ = 0;  // of the last step, with its sign

    double largest(const std::vector<double>& x) const {
        double most = 0;
        for (int n = 0; n < system_.size(); ++n)
            if (system_.is_voltage(n)) most = std::max(most, std::abs(x[static_cast<std::size_t>(n)]));
        return most;
    }
    /// next = (c C - g G) v
    void multiply(double c, double g) {
        const auto& p = system_.pattern();
        std::fill(next_.begin(), next_.end(), 0.0);
        for (int column = 0; column < p.size(); ++column)
            for (int e = p.begin()[static_cast<std::size_t>(column)]; e < p.begin()[static_cast<std::size_t>(column) + 1]; ++e) {
                const auto k = static_cast<std::size_t>(e);
                next_[static_cast<std::size_t>(p.rows()[k])] += (c * C_[k] - g * G_[k]) * v_[static_cast<std::size_t>(column)];
            }
    }
    /// v = next, as long as 1; returns how long it was. 0: it cannot be told.
    double take() {
        const double most = largest(next_);
        if (!(most > 0) || !std::isfinite(most)) return 0;
        std::size_t at = 0;
        for (std::size_t n = 0; n < v_.size(); ++n)
            if (std::abs(next_[n]) > std::abs(next_[at])) at = n;
        ratio_ = v_[at] == 0 ? 0 : next_[at] / v_[at];
        for (std::size_t n = 0; n < v_.size(); ++n) v_[n] = next_[n] / most;
        return most;
    }

public:
    Disturbance(const System& system, std::span<const double> G, std::span<const double> C) : system_(system), G_(G), C_(C) {
        sum_.resize(G.size()), next_.resize(static_cast<std::size_t>(system.size()));
    }

    /// By how much it grows a step in the long run.
    double grow(double a) {
        constexpr int steps = 80;
        for (std::size_t k = 0; k < sum_.size(); ++k) sum_[k] = G_[k] + a * C_[k];
        Solver<double> solver(system_.pattern());
        if (!solver.factor(sum_)) return 0;
        v_.assign(next_.size(), 0);
        for (std::size_t n = 0; n < v_.size(); ++n) v_[n] = 1 - 2 * std::fmod(0.6180339887498949 * static_cast<double>(n + 1), 1.0);
        double length = 1;
        for (int k = 0; k < steps; ++k) {
            // At first without the part that no charge holds, which M would only turn round.
            k < 4 ? multiply(a, 0) : multiply(a, 1);
            solver.solve(next_);
            const double most = take();
            if (most == 0) return 0;
            if (k >= steps / 2) length *= most;
        }
        return std::pow(length, 2.0 / steps);
    }
    const std::vector<double>& direction() const { return v_; }
    double ratio() const { return ratio_; }
};

}  // namespace

std::optional<Growth> growth_at(Newton& newton, std::span<const double> x) {
    const System& system = newton.system;
    Instant at = newton.instant;
    at.charges = true;
    auto memory = newton.memory;
    system.eval(x, at, memory, newton.sums);
    const auto entries = system.pattern().entries();
    Disturbance disturbance(system, std::span(newton.sums.G).first(entries), std::span(newton.sums.C).first(entries));
    double most = 1.02, best = 0;
    for (double a = 1e-2; a < 1e13; a *= 10)
        if (const double by = disturbance.grow(a); by > most) most = by, best = a;
    if (best == 0) return {};
    (void)disturbance.grow(best);
    const double z = disturbance.ratio(), rate = best * (z - 1) / (z + 1);
    const bool steady = std::abs(std::abs(z) / most - 1) < 1e-3 && rate > 0;
    return Growth{disturbance.direction(), steady ? rate : 0};
}

}  // namespace corpuscle::circuit
