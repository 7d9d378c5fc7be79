#include <algorithm>
#include <cmath>

#include "circuit/devices.hpp"
#include "circuit/solve/operating_point.hpp"
#include "core/text/quantity.hpp"

namespace corpuscle::circuit {
namespace {

/// The largest change of a node voltage in one iteration, V: half the largest source voltage, at least 0.3 V.
double max_voltage_step(const System& system) {
    double limit = 0.3;
    const auto& elements = system.circuit().elements;
    for (std::size_t k = 0; k < elements.size(); ++k)
        if (has_role(elements[k], Role::voltage_source))
            limit = std::max(limit, std::abs(system.devices()[k]->principal_value().value_or(0)) / 2);
    return limit;
}

}  // namespace

NewtonSolver::NewtonSolver(const System& s, const Tolerances& t)
    : system(s), tolerances(t), linear_solver(s.pattern()), limiting_state(s.initial_limiting_state()) {
    context.gmin = t.gmin, context.with_charges = false;
    step.resize(static_cast<std::size_t>(s.size()));
}

bool NewtonSolver::is_balanced() const {
    // The equation of a node is a sum of currents, that of a branch current a sum of voltages.
    for (std::size_t n = 0; n < evaluation.f.size(); ++n) {
        const double floor = n < static_cast<std::size_t>(system.nodes()) ? tolerances.abstol : tolerances.vntol;
        if (!(std::abs(evaluation.f[n]) <= tolerances.reltol * evaluation.scale[n] + evaluation.roundoff[n] + floor)) return false;
    }
    return true;
}

bool NewtonSolver::solve(std::vector<double>& x, const NodeClamps& clamps, int max_iterations) {
    const auto count = static_cast<std::size_t>(system.size()), nodes = static_cast<std::size_t>(system.nodes());
    const bool linear = system.is_linear();
    const double limit = linear ? 0 : max_voltage_step(system);
    bool is_close = false;  // the last step was below the tolerances
    singular_unknown = -1;
    for (int k = 0; k < (max_iterations > 0 ? max_iterations : tolerances.itl1); ++k) {
        system.eval(x, context, limiting_state, evaluation);
        ++iterations;
        for (std::size_t n = 0; n < nodes && !clamps.conductance.empty(); ++n) {
            evaluation.f[n] += clamps.conductance[n] * (x[n] - clamps.voltage[n]);
            evaluation.G[system.pattern().entry_index(static_cast<int>(n), static_cast<int>(n))] += clamps.conductance[n];
            evaluation.scale[n] = std::max(evaluation.scale[n], clamps.conductance[n] * std::abs(x[n]));
        }
        if (is_close && !evaluation.is_limited && is_balanced()) return true;
        if (!linear_solver.factor(std::span<const double>(evaluation.G).first(system.pattern().entries()))) {
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
            if (voltage && limit > 0 && std::abs(step[n]) > limit) step[n] = std::copysign(limit, step[n]);
            const double floor = voltage ? tolerances.vntol : tolerances.abstol + 1e-13 * largest_current;
            is_close &= std::abs(step[n]) <= tolerances.reltol * std::max(std::abs(x[n]), std::abs(x[n] + step[n])) + floor;
            x[n] += step[n];
        }
    }
    return false;
}

std::string NewtonSolver::describe_residual(std::span<const double> x) {
    system.eval(x, context, limiting_state, evaluation);
    std::size_t worst = 0;
    double largest = -1;
    for (std::size_t n = 0; n < evaluation.f.size(); ++n) {
        const double relative_residual =
            std::isfinite(evaluation.f[n])
                ? std::abs(evaluation.f[n]) / (tolerances.reltol * evaluation.scale[n] + evaluation.roundoff[n] + tolerances.abstol)
                : 1e300;
        if (relative_residual > largest) largest = relative_residual, worst = n;
    }
    const Device* device = nullptr;
    StampBuffer buffer;
    double contribution = -1;
    for (const auto& d : system.devices()) {
        const auto at = std::find(d->unknowns.begin(), d->unknowns.end(), static_cast<int>(worst));
        if (at == d->unknowns.end()) continue;
        const auto stamp = buffer.eval(*d, system.terminal_values(*d, x), context);
        const double f = std::abs(stamp.f[static_cast<std::size_t>(at - d->unknowns.begin())]);
        if (!(f <= contribution)) contribution = f, device = d.get();
    }
    const bool is_current = worst < static_cast<std::size_t>(system.nodes());
    return fmt::format("largest residual: {1} at {0}{2}", system.names()[worst],
                       format_quantity(evaluation.f[worst], is_current ? "A" : "V"),
                       device ? fmt::format(", mostly from {}", device->name) : "");
}

}  // namespace corpuscle::circuit
