#include <complex>

#include "circuit/devices.hpp"
#include "circuit/solve/operating_point.hpp"
#include "core/text/quantity.hpp"

namespace corpuscle::circuit {
namespace {

/// True if the circuit has devices that keep a step in bounds, such as bipolar transistors, and all its nonlinear devices limit their
/// steps.
bool devices_bound_steps(const System& system) {
    const auto& devices = system.devices();
    return std::ranges::any_of(devices, [](const auto& d) { return d->bounds_steps(); }) &&
           std::ranges::all_of(devices, [](const auto& d) { return d->is_linear() || d->limits(); });
}

/// The largest change of a node voltage in one iteration, V: half the largest source voltage, at least 0.3 V. 0: any change is allowed. In
/// circuits of bipolar transistors a limit for each node would only make the voltages inconsistent: the operational amplifier 741 then
/// takes 500 iterations instead of 13.
double max_voltage_step(const System& system) {
    if (devices_bound_steps(system)) return 0;
    double limit = 0.3;
    const auto& elements = system.circuit().elements;
    for (std::size_t k = 0; k < elements.size(); ++k)
        if (has_role(elements[k], Role::voltage_source))
            limit = std::max(limit, std::abs(system.devices()[k]->principal_value().value_or(0)) / 2);
    return limit;
}

/// Limits the change of each node voltage in one iteration. The limit of a voltage that has reached it several times in the same direction
/// doubles with each further time, since the solution may be far away: an amplifier model may have megavolts inside.
class VoltageStepLimit {
    static constexpr int usual_steps = 40;  // steps of the first limit: more than a circuit without internal gain needs
    double first_;                          // V; 0: no limit
    std::vector<int> limited_;              // by unknown: how often the limit was reached in a row, negative for falling voltages

public:
    VoltageStepLimit(double first, std::size_t unknowns) : first_(first), limited_(first > 0 ? unknowns : 0) {}
    double limit(double step, std::size_t unknown) {
        if (first_ == 0) return step;
        int& count = limited_[unknown];
        const int steps_so_far = step > 0 ? std::max(count, 0) : std::max(-count, 0);
        const double most = std::ldexp(first_, std::clamp(steps_so_far - usual_steps, 0, 1000));
        if (std::abs(step) <= most) return count = 0, step;
        count = step > 0 ? steps_so_far + 1 : -steps_so_far - 1;
        return std::copysign(most, step);
    }
};

/// Power iteration. A disturbance v exp(lambda t) satisfies (G + lambda C) v = 0. M = (G + a C)^-1 (a C - G) maps v to
/// v (a + lambda) / (a - lambda), which is longer than v if the disturbance grows, and longest for a near |lambda|. So repeated
/// multiplication by M, with a in each decade, finds the growing disturbance.
class Disturbance {
    const System& system_;
    std::span<const double> G_, C_;
    std::optional<LinearSolver<double>> solver_;
    bool keeps_solver_ = false;               // its order of pivots is fixed for all matrices
    std::vector<double> sum_, v_, next_;      // sum_ = G + a C; v_: present disturbance; next_: buffer for M v
    double ratio_ = 0;                        // factor of the largest element of v in the last multiplication, with its sign
    std::vector<double> last_, second_last_;  // the disturbances one and two multiplications before, on the scale of v_

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
        std::swap(second_last_, last_);
        last_ = v_;
        for (auto* before : {&last_, &second_last_})
            for (double& x : *before) x /= length;
        for (std::size_t n = 0; n < v_.size(); ++n) v_[n] = next_[n] / length;
        return length;
    }

public:
    static constexpr double least_growth = 1.02;  // smaller growth per multiplication is not counted

    Disturbance(const System& system, std::span<const double> G, std::span<const double> C) : system_(system), G_(G), C_(C) {
        sum_.resize(G.size()), next_.resize(static_cast<std::size_t>(system.size()));
    }

    /// The mean factor by which a multiplication by M with this a (1/s) increases the disturbance, after many multiplications; 0 if they
    /// fail.
    double growth_per_step(double a) {
        constexpr int steps = 80;
        for (std::size_t k = 0; k < sum_.size(); ++k) sum_[k] = G_[k] + a * C_[k];
        if (!keeps_solver_) keeps_solver_ = solver_.emplace(system_.pattern()).prefer_fronts(sum_);
        if (!solver_->factor(sum_)) return 0;
        v_.assign(next_.size(), 0), last_ = second_last_ = v_;
        // Start with different numbers for all unknowns.
        for (std::size_t n = 0; n < v_.size(); ++n) v_[n] = 1 - 2 * std::fmod(0.6180339887498949 * static_cast<double>(n + 1), 1.0);
        double length = 1;
        for (int k = 0; k < steps; ++k) {
            // The first multiplications, by (G + a C)^-1 a C, remove the components without charge, for which M only changes the sign.
            k < 4 ? multiply(a, 0) : multiply(a, 1);
            solver_->solve(next_);
            const double factor = normalize();
            if (factor == 0) return 0;
            if (k >= steps / 2) length *= factor;
        }
        return std::pow(length, 2.0 / steps);
    }
    /// The complex factor z by which a multiplication changes the disturbance now, that of the larger magnitude: the last three
    /// disturbances satisfy w2 = p w1 - q w0, where z^2 = p z - q. If they do not, more than one pair is left, and there is no factor.
    std::optional<std::complex<double>> factor() const {
        double s00 = 0, s01 = 0, s11 = 0, s02 = 0, s12 = 0, s22 = 0;
        for (std::size_t n = 0; n < v_.size(); ++n) {
            const double w0 = second_last_[n], w1 = last_[n], w2 = v_[n];
            s00 += w0 * w0, s01 += w0 * w1, s11 += w1 * w1, s02 += w0 * w2, s12 += w1 * w2, s22 += w2 * w2;
        }
        const double determinant = s00 * s11 - s01 * s01;
        if (!(determinant > 1e-10 * s00 * s11)) return ratio_;  // w0 and w1 are parallel: z is real
        const double p = (s12 * s00 - s02 * s01) / determinant, q = (s12 * s01 - s02 * s11) / determinant;
        const double error = s22 - 2 * p * s12 + 2 * q * s02 + p * p * s11 - 2 * p * q * s01 + q * q * s00;
        if (!(error < 1e-6 * s22)) return {};
        const auto root = std::sqrt(std::complex<double>(p * p / 4 - q));
        return p > 0 ? p / 2 + root : p / 2 - root;
    }
    /// True if the disturbance found with this a really grows. A pair of factors that only turns it can make its voltages larger for a
    /// while, and rounding errors can make it longer where the matrices are nearly singular. So its rate must be found again with another
    /// a.
    bool grows(double a, double growth) {
        const auto z = factor();
        if (!z) return growth > 1.2;  // several disturbances are left
        if (!(std::abs(*z) > least_growth)) return false;
        const auto rate = a * (*z - 1.0) / (*z + 1.0);
        // A faster disturbance is found, more clearly, with a larger a. Unless it is none: where a current source feeds an inductor, a
        // disturbance becomes longer by the same amount, not by the same factor, in each multiplication.
        if (std::abs(rate) > 10 * a) return false;
        const double other_a = 1.7 * a, expected = std::abs((other_a + rate) / (other_a - rate));
        if (growth_per_step(other_a) == 0) return false;
        const auto other = factor();
        return !other || std::abs(std::abs(*other) / expected - 1) < 0.05;
    }
    const std::vector<double>& direction() const { return v_; }
    /// The last growth factor with its sign.
    double ratio() const { return ratio_; }
};

}  // namespace

NewtonSolver::NewtonSolver(const System& s, const Tolerances& t)
    : system(s), tolerances(t), linear_solver(s.pattern()), limiting_state(s.initial_limiting_state()) {
    context.gmin = t.gmin, context.with_charges = false;
    step.resize(static_cast<std::size_t>(s.size()));
}

double NewtonSolver::floor_of(std::size_t equation) const {
    return equation < static_cast<std::size_t>(system.nodes()) ? tolerances.abstol : tolerances.vntol;
}

bool NewtonSolver::is_balanced() const {
    for (std::size_t n = 0; n < evaluation.f.size(); ++n)
        if (!(std::abs(evaluation.f[n]) <= tolerances.reltol * evaluation.scale[n] + evaluation.roundoff[n] + floor_of(n))) return false;
    return true;
}

bool NewtonSolver::solve(std::vector<double>& x, const NodeClamps& clamps, int max_iterations) {
    const auto count = static_cast<std::size_t>(system.size()), nodes = static_cast<std::size_t>(system.nodes());
    const bool linear = system.is_linear();
    VoltageStepLimit voltage_limit(linear ? 0 : max_voltage_step(system), count);
    bool is_close = false;  // the last step was below the tolerances
    singular_unknown = -1;
    for (int k = 0; k < (max_iterations > 0 ? max_iterations : tolerances.itl1); ++k) {
        if (is_stopped()) return false;
        system.eval(x, context, limiting_state, evaluation);
        ++iterations;
        for (std::size_t n = 0; n < nodes && !clamps.conductance.empty(); ++n) {
            evaluation.f[n] += clamps.conductance[n] * (x[n] - clamps.voltage[n]);
            evaluation.G[system.pattern().entry_index(static_cast<int>(n), static_cast<int>(n))] += clamps.conductance[n];
            evaluation.scale[n] = std::max(evaluation.scale[n], clamps.conductance[n] * std::abs(x[n]));
        }
        if (is_close && !evaluation.is_limited && is_balanced()) return true;
        const auto G = std::span<const double>(evaluation.G).first(system.pattern().entries());
        if (k == 0 && !linear_solver.has_fixed_order()) linear_solver.prefer_fronts(G);
        if (!linear_solver.factor(G)) {
            singular_unknown = linear_solver.singular_column();
            return false;
        }
        for (std::size_t n = 0; n < count; ++n) step[n] = -evaluation.f[n];
        linear_solver.solve(step);
        if (!std::all_of(step.begin(), step.end(), [](double d) { return std::isfinite(d); })) return false;
        double largest_current = 0;
        for (std::size_t n = 0; n < count; ++n)
            if (!system.is_voltage(static_cast<int>(n))) largest_current = std::max(largest_current, std::abs(x[n]));
        is_close = true;
        for (std::size_t n = 0; n < count; ++n) {
            const bool voltage = system.is_voltage(static_cast<int>(n));
            if (voltage) step[n] = voltage_limit.limit(step[n], n);
            const double floor = voltage ? tolerances.vntol : tolerances.abstol + 1e-13 * largest_current;
            is_close &= std::abs(step[n]) <= tolerances.reltol * std::max(std::abs(x[n]), std::abs(x[n] + step[n])) + floor;
            x[n] += step[n];
        }
    }
    return false;
}

std::string NewtonSolver::describe_residual(std::span<const double> x, double a, std::span<const double> history) {
    system.eval(x, context, limiting_state, evaluation);
    const auto residual_of = [&](std::size_t n) { return evaluation.f[n] + (history.empty() ? 0 : a * evaluation.q[n] + history[n]); };
    std::size_t worst = 0;
    double largest = -1;
    for (std::size_t n = 0; n < evaluation.f.size(); ++n) {
        const double residual = std::abs(residual_of(n)), rate = history.empty() ? 0 : std::abs(a * evaluation.q[n]);
        const double allowed = tolerances.reltol * std::max(evaluation.scale[n], rate) + evaluation.roundoff[n] + floor_of(n);
        const double relative_residual = std::isfinite(residual) ? residual / allowed : 1e300;
        if (relative_residual > largest) largest = relative_residual, worst = n;
    }
    const Device* device = nullptr;
    StampBuffer buffer;
    double contribution = -1;
    for (const auto& d : system.devices()) {
        const auto at = std::find(d->unknowns.begin(), d->unknowns.end(), static_cast<int>(worst));
        if (at == d->unknowns.end()) continue;
        const auto stamp = buffer.eval(*d, system.terminal_values(*d, x), context);
        const auto k = static_cast<std::size_t>(at - d->unknowns.begin());
        const double f = std::abs(stamp.f[k] + (history.empty() ? 0 : a * stamp.q[k]));
        if (!(f <= contribution)) contribution = f, device = d.get();
    }
    const bool is_current = worst < static_cast<std::size_t>(system.nodes());
    return fmt::format("largest residual: {1} at {0}{2}", system.names()[worst],
                       format_quantity(residual_of(worst), is_current ? "A" : "V"),
                       device ? fmt::format(", mostly from {}", device->name) : "");
}

std::optional<UnstableMode> find_unstable_mode(NewtonSolver& newton, std::span<const double> x) {
    const System& system = newton.system;
    EvalContext context = newton.context;
    context.with_charges = true;
    auto limiting_state = newton.limiting_state;
    system.eval(x, context, limiting_state, newton.evaluation);
    const auto entries = system.pattern().entries();
    Disturbance disturbance(system, std::span(newton.evaluation.G).first(entries), std::span(newton.evaluation.C).first(entries));
    double largest = Disturbance::least_growth, best = 0;  // best: a of the largest growth
    for (double a = 1e-2; a < 1e13; a *= 10)
        if (const double growth = disturbance.growth_per_step(a); growth > largest && disturbance.grows(a, growth))
            largest = growth, best = a;
    if (best == 0) return {};
    (void)disturbance.growth_per_step(best);  // for direction() and ratio()
    const double z = disturbance.ratio(), rate = best * (z - 1) / (z + 1);
    // A disturbance that does not oscillate grows by the same factor in each multiplication: ratio = (a + rate) / (a - rate).
    const bool steady = std::abs(std::abs(z) / largest - 1) < 1e-3 && rate > 0;
    return UnstableMode{disturbance.direction(), steady ? rate : 0};
}

}  // namespace corpuscle::circuit
