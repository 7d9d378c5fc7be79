#include "circuit/solve/operating_point.hpp"

#include <algorithm>
#include <cmath>

namespace corpuscle::circuit {
namespace {

/// Power iteration. A disturbance v exp(lambda t) satisfies (G + lambda C) v = 0. M = (G + a C)^-1 (a C - G) maps v to
/// v (a + lambda) / (a - lambda), which is longer than v if the disturbance grows, and longest for a near |lambda|. So repeated
/// multiplication by M, with a in each decade, finds the growing disturbance.
class Disturbance {
    const System& system_;
    std::span<const double> G_, C_;
    std::vector<double> sum_, v_, next_;  // sum_ = G + a C; v_: present disturbance; next_: buffer for M v
    double ratio_ = 0;                    // factor of the largest element of v in the last multiplication, with its sign

    double largest_voltage(const std::vector<double>& x) const {
        double largest = 0;
        for (int n = 0; n < system_.size(); ++n)
            if (system_.is_voltage(n)) largest = std::max(largest, std::abs(x[static_cast<std::size_t>(n)]));
        return largest;
    }
    /// next = (c C - g G) v
    void multiply(double c, double g) {
        std::fill(next_.begin(), next_.end(), 0.0);
        system_.pattern().for_each_entry(
            [&](std::size_t e, std::size_t row, std::size_t column) { next_[row] += (c * C_[e] - g * G_[e]) * v_[column]; });
    }
    /// v = next, normalized so that the largest voltage is 1. Returns the largest voltage before; 0 if it is zero or not finite.
    double normalize() {
        const double length = largest_voltage(next_);
        if (!(length > 0) || !std::isfinite(length)) return 0;
        std::size_t peak = 0;
        for (std::size_t n = 0; n < v_.size(); ++n)
            if (std::abs(next_[n]) > std::abs(next_[peak])) peak = n;
        ratio_ = v_[peak] == 0 ? 0 : next_[peak] / v_[peak];
        for (std::size_t n = 0; n < v_.size(); ++n) v_[n] = next_[n] / length;
        return length;
    }

public:
    Disturbance(const System& system, std::span<const double> G, std::span<const double> C) : system_(system), G_(G), C_(C) {
        sum_.resize(G.size()), next_.resize(static_cast<std::size_t>(system.size()));
    }

    /// The mean factor by which a multiplication by M with this a (1/s) increases the disturbance, after many multiplications; 0 if they
    /// fail.
    double growth_per_step(double a) {
        constexpr int steps = 80;
        for (std::size_t k = 0; k < sum_.size(); ++k) sum_[k] = G_[k] + a * C_[k];
        LinearSolver<double> solver(system_.pattern());
        if (!solver.factor(sum_)) return 0;
        v_.assign(next_.size(), 0);
        // Start with different numbers for all unknowns.
        for (std::size_t n = 0; n < v_.size(); ++n) v_[n] = 1 - 2 * std::fmod(0.6180339887498949 * static_cast<double>(n + 1), 1.0);
        double length = 1;
        for (int k = 0; k < steps; ++k) {
            // The first multiplications, by (G + a C)^-1 a C, remove the components without charge, for which M only changes the sign.
            k < 4 ? multiply(a, 0) : multiply(a, 1);
            solver.solve(next_);
            const double factor = normalize();
            if (factor == 0) return 0;
            if (k >= steps / 2) length *= factor;
        }
        return std::pow(length, 2.0 / steps);
    }
    const std::vector<double>& direction() const { return v_; }
    /// The last growth factor with its sign.
    double ratio() const { return ratio_; }
};

}  // namespace

std::optional<UnstableMode> find_unstable_mode(NewtonSolver& newton, std::span<const double> x) {
    const System& system = newton.system;
    EvalContext context = newton.context;
    context.with_charges = true;
    auto limiting_state = newton.limiting_state;
    system.eval(x, context, limiting_state, newton.evaluation);
    const auto entries = system.pattern().entries();
    Disturbance disturbance(system, std::span(newton.evaluation.G).first(entries), std::span(newton.evaluation.C).first(entries));
    double largest = 1.02, best = 0;  // smaller growth per multiplication is not counted; best: a of the largest growth
    for (double a = 1e-2; a < 1e13; a *= 10)
        if (const double growth = disturbance.growth_per_step(a); growth > largest) largest = growth, best = a;
    if (best == 0) return {};
    (void)disturbance.growth_per_step(best);  // for direction() and ratio()
    const double z = disturbance.ratio(), rate = best * (z - 1) / (z + 1);
    // A disturbance that does not oscillate grows by the same factor in each multiplication: ratio = (a + rate) / (a - rate).
    const bool steady = std::abs(std::abs(z) / largest - 1) < 1e-3 && rate > 0;
    return UnstableMode{disturbance.direction(), steady ? rate : 0};
}

}  // namespace corpuscle::circuit
