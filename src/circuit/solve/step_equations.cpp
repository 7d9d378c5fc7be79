#include "circuit/solve/step_equations.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double doubtful_growth = 1e4;     // Elimination::growth() at and above which the solution is checked
constexpr double doubtful_residual = 1e-9;  // relative residual at and above which the matrix is factored again with new pivots

}  // namespace

StepEquations::StepEquations(const System& system, NewtonSolver& newton)
    : system_(system), newton_(newton), batched_devices_(system), solver_(system.pattern()) {
    const auto count = static_cast<std::size_t>(system.size());
    x_.resize(count + 1), base_.resize(count + 1), r_.resize(count + 1), step_.resize(count + 1);
    J_.resize(system.pattern().entries() + 1), J_0_.resize(J_.size());
    for (int n = 0; n < system.size(); ++n) is_voltage_.push_back(system.is_voltage(n));
    for (const auto k : system.scalar_devices()) {
        const Device& d = *system.devices()[k];
        if (d.is_linear() && d.is_time_dependent()) time_dependent_.push_back(k);
        if (d.is_linear()) continue;
        const auto n = d.unknowns.size();
        scalar_devices_.push_back({k, n, d.unknowns, std::vector<double>(n), std::vector<double>(n), {}, {}});
        for (int& u : scalar_devices_.back().unknowns) u = u < 0 ? static_cast<int>(count) : u;
    }
    auto sums = sum_linear_devices(system, newton.context);
    constant_currents_ = std::move(sums.currents);
    system.pattern().for_each_entry([&](std::size_t e, std::size_t row, std::size_t column) {
        for (auto* list : {&linear_, &linear_charges_}) {
            if (sums.C[e] == 0 && (sums.G[e] == 0 || list == &linear_charges_)) continue;
            list->entry.push_back(static_cast<int>(e));
            list->row.push_back(static_cast<int>(row)), list->column.push_back(static_cast<int>(column));
            list->g.push_back(sums.G[e]), list->c.push_back(sums.C[e]);
        }
    });
}

void StepEquations::prepare(double t, double a, std::span<const double> history) {
    newton_.context.time = t, newton_.context.with_charges = true;
    a_ = a, newton_control_.begin();
    base_ = constant_currents_;
    for (std::size_t n = 0; n < history.size(); ++n) base_[n] += history[n];
    for (const auto k : time_dependent_) {
        const Device& d = *system_.devices()[k];
        scratch_.assign(d.unknowns.size(), 0.0);
        const auto f = stamp_.eval(d, scratch_, newton_.context).f;
        for (std::size_t row = 0; row < f.size(); ++row)
            if (d.unknowns[row] >= 0) base_[static_cast<std::size_t>(d.unknowns[row])] += f[row];
    }
    std::fill(J_0_.begin(), J_0_.end(), 0.0);
    for (std::size_t k = 0; k < linear_.entry.size(); ++k)
        J_0_[static_cast<std::size_t>(linear_.entry[k])] = linear_.g[k] + a * linear_.c[k];
}

/// Evaluates a nonlinear device at x_, limited if necessary, and adds it to J_ and r_.
void StepEquations::linearize_device(ScalarDevice& scalar) {
    const Device& d = *system_.devices()[scalar.device];
    const auto n = scalar.terminals;
    for (std::size_t j = 0; j < n; ++j) scalar.v[j] = x_[static_cast<std::size_t>(scalar.unknowns[j])];
    scalar.linearized_at = scalar.v;
    scalar.limited = d.limits() && d.limit(scalar.linearized_at, system_.limiting_state_of(scalar.device, newton_.limiting_state));
    limited_ |= scalar.limited;
    const Stamp stamp = scalar.stamp = scalar.buffer.eval(d, scalar.linearized_at, newton_.context);
    const auto entries = system_.entries(scalar.device);
    for (std::size_t row = 0; row < n; ++row) {
        for (std::size_t column = 0; column < n; ++column) {
            const double slope = stamp.slope(row, column), c = stamp.capacitance(row, column);
            if (scalar.limited)
                stamp.f[row] += slope * (scalar.v[column] - scalar.linearized_at[column]),
                    stamp.q[row] += c * (scalar.v[column] - scalar.linearized_at[column]);
            J_[entries[row * n + column]] += slope + a_ * c;
        }
        r_[static_cast<std::size_t>(scalar.unknowns[row])] += stamp.f[row] + a_ * stamp.q[row];
    }
}

/// Computes r and J at x.
void StepEquations::linearize(std::span<const double> x) {
    std::copy(x.begin(), x.end(), x_.begin());
    J_ = J_0_, r_ = base_;
    for (std::size_t k = 0; k < linear_.entry.size(); ++k)
        r_[static_cast<std::size_t>(linear_.row[k])] +=
            J_0_[static_cast<std::size_t>(linear_.entry[k])] * x_[static_cast<std::size_t>(linear_.column[k])];
    limited_ = false;
    for (auto& scalar : scalar_devices_) linearize_device(scalar);
    batched_devices_.evaluate(newton_.context, a_, x_, J_, r_);
}

/// In a circuit with transistors that are evaluated together, which do not limit their voltages themselves, limits the voltages of the
/// Newton step to 0.5 V. Elsewhere a voltage may jump by any number of volts, as where a switch opens at a coil. Returns the largest
/// component of the step, relative to the allowed error. Sets `clamped` if a voltage was limited.
double StepEquations::largest_step(std::span<const double> allowed, bool& clamped) {
    double largest = 0;
    for (std::size_t n = 0; n < allowed.size(); ++n) {
        double& d = step_[n];
        if (!std::isfinite(d)) return d;
        if (is_voltage_[n] && !system_.groups().empty() && std::abs(d) > 0.5) d = std::copysign(0.5, d), clamped = true;
        if (allowed[n] > 0) largest = std::max(largest, std::abs(d) / allowed[n]);
    }
    return largest;
}

/// Solves J step + r = 0. Returns false if J is singular.
bool StepEquations::solve_for_step() {
    const auto J = std::span<const double>(J_).first(J_.size() - 1);
    const auto step = std::span(step_).first(step_.size() - 1);
    const auto solve = [&] {
        for (std::size_t n = 0; n < step.size(); ++n) step[n] = -r_[n];
        solver_.solve(step);
    };
    if (!solver_.factor(J)) return false;
    solve();
    if (solver_.growth() < doubtful_growth || relative_residual() < doubtful_residual) return true;
    if (!solver_.factor_with_new_pivots(J)) return false;
    return solve(), true;
}

/// The largest residual of J step + r, relative to the largest term of its row.
double StepEquations::relative_residual() {
    scratch_.assign(r_.begin(), r_.end());
    std::vector<double> largest(r_.size());
    system_.pattern().for_each_entry([&](std::size_t e, std::size_t row, std::size_t column) {
        const double term = J_[e] * step_[column];
        scratch_[row] += term, largest[row] = std::max(largest[row], std::abs(term));
    });
    double largest_residual = 0;
    for (std::size_t n = 0; n + 1 < r_.size(); ++n)
        if (largest[n] > 0) largest_residual = std::max(largest_residual, std::abs(scratch_[n]) / std::max(largest[n], std::abs(r_[n])));
    return largest_residual;
}

StepEquations::Status StepEquations::iterate(std::vector<double>& x, std::span<const double> allowed) {
    linearize(x);
    ++iterations;
    if (!solve_for_step()) return Status::diverged;
    bool clamped = false;
    const double size = largest_step(allowed, clamped);
    if (!std::isfinite(size)) return Status::diverged;
    for (std::size_t n = 0; n < x.size(); ++n) x[n] += step_[n];
    if (system_.is_linear()) return Status::converged;
    const auto status = newton_control_.update(size, limited_ || clamped);
    return status != Status::converged || !checks_expressions_ || expressions_match() ? status : newton_control_.continue_iterating();
}

/// Compares the expressions after the Newton step with their linearizations.
bool StepEquations::expressions_match() {
    for (const auto& scalar : scalar_devices_) {
        const Device& d = *system_.devices()[scalar.device];
        if (!d.has_jumps()) continue;
        const auto n = scalar.terminals;
        auto& v = scratch_;
        v.clear();
        for (const int u : scalar.unknowns) v.push_back(x_[static_cast<std::size_t>(u)] + step_[static_cast<std::size_t>(u)]);
        const auto f = stamp_.eval(d, v, newton_.context).f;
        for (std::size_t row = 0; row < n; ++row) {
            double linear = scalar.stamp.f[row];
            for (std::size_t column = 0; column < n; ++column) linear += scalar.stamp.slope(row, column) * (v[column] - scalar.v[column]);
            const bool is_voltage = scalar.unknowns[row] < system_.size() && !is_voltage_[static_cast<std::size_t>(scalar.unknowns[row])];
            if (!expression_tolerance_.accepts(is_voltage, f[row], linear, v)) return false;
        }
    }
    return true;
}

/// Adds C x of the linear devices to r_.
void StepEquations::add_linear_charges(std::span<const double> x) {
    const auto& list = linear_charges_;
    for (std::size_t k = 0; k < list.c.size(); ++k)
        r_[static_cast<std::size_t>(list.row[k])] += list.c[k] * x[static_cast<std::size_t>(list.column[k])];
}

void StepEquations::read_charges(std::span<double> q) {
    const auto count = q.size();
    for (std::size_t n = 0; n < count; ++n) x_[n] += step_[n];  // last evaluation plus the Newton step
    std::fill(r_.begin(), r_.end(), 0.0);
    add_linear_charges(x_);
    for (const auto& scalar : scalar_devices_) {
        const auto n = scalar.terminals;
        for (std::size_t row = 0; row < n; ++row) {
            double sum = scalar.stamp.q[row];
            for (std::size_t column = 0; column < n; ++column)
                sum += scalar.stamp.capacitance(row, column) * step_[static_cast<std::size_t>(scalar.unknowns[column])];
            r_[static_cast<std::size_t>(scalar.unknowns[row])] += sum;
        }
    }
    batched_devices_.add_charges(step_, r_);
    std::copy(r_.begin(), r_.begin() + static_cast<std::ptrdiff_t>(count), q.begin());
}

void StepEquations::charge_change(std::span<const double> dx, std::span<double> dq) {
    std::fill(r_.begin(), r_.end(), 0.0);
    add_linear_charges(dx);
    const auto change_of = [&](int unknown) {
        return static_cast<std::size_t>(unknown) < dx.size() ? dx[static_cast<std::size_t>(unknown)] : 0;
    };
    for (const auto& scalar : scalar_devices_)
        for (std::size_t row = 0; row < scalar.terminals; ++row)
            for (std::size_t column = 0; column < scalar.terminals; ++column)
                r_[static_cast<std::size_t>(scalar.unknowns[row])] +=
                    scalar.stamp.capacitance(row, column) * change_of(scalar.unknowns[column]);
    std::copy(r_.begin(), r_.begin() + static_cast<std::ptrdiff_t>(dq.size()), dq.begin());
}

void StepEquations::add_rounding(std::span<const double> x, std::span<double> out) const {
    constexpr double roundoff = 1e-15;
    system_.pattern().for_each_entry(
        [&](std::size_t e, std::size_t row, std::size_t column) { out[row] += roundoff * std::abs(J_[e] * x[column]); });
}

void StepEquations::evaluate_static(double t, std::span<const double> x, std::span<double> f, std::span<double> q) {
    constexpr int max_evaluations = 100;
    prepare(t, 0, {});
    linearize(x);
    for (int k = 1; limited_ && k < max_evaluations; ++k) linearize(x);  // until limit() changes no voltage; otherwise the charge is wrong
    std::copy(r_.begin(), r_.begin() + static_cast<std::ptrdiff_t>(f.size()), f.begin());
    std::fill(step_.begin(), step_.end(), 0.0);
    read_charges(q);
}

void StepEquations::fix_pivot_order(std::span<const double> x, double a) {
    prepare(newton_.context.time, a, {});
    linearize(x);
    solver_.fix_pivot_order(std::span<const double>(J_).first(J_.size() - 1));
}

}  // namespace corpuscle::circuit
