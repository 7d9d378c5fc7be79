#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "circuit/solve/operating_point.hpp"
#include "signal/quantity.hpp"

namespace corpuscle::circuit {
namespace {

/// The largest change of a node voltage in one iteration, V: half the largest source voltage, at least 0.3 V.
double max_voltage_step(const System& system) {
    double limit = 0.3;
    const auto& elements = system.circuit().elements;
    for (std::size_t k = 0; k < elements.size(); ++k)
        if (elements[k].letter == 'v') limit = std::max(limit, std::abs(system.devices()[k]->setting().value_or(0)) / 2);
    return limit;
}

}  // namespace

Newton::Newton(const System& s, const Tolerances& t) : system(s), tolerances(t), solver(s.pattern()), memory(s.fresh_memory()) {
    instant.gmin = t.gmin, instant.charges = false;
    step.resize(static_cast<std::size_t>(s.size()));
}

bool Newton::balanced() const {
    for (std::size_t n = 0; n < sums.f.size(); ++n) {
        const double floor = n < static_cast<std::size_t>(system.nodes()) ? tolerances.abstol : tolerances.vntol;
        if (!(std::abs(sums.f[n]) <= tolerances.reltol * sums.size[n] + sums.grain[n] + floor)) return false;
    }
    return true;
}

bool Newton::run(std::vector<double>& x, const Springs& clamps, int max_iterations) {
    const auto count = static_cast<std::size_t>(system.size()), nodes = static_cast<std::size_t>(system.nodes());
    const bool linear = system.linear();
    const double limit = linear ? 0 : max_voltage_step(system);
    bool is_close = false;  // the last step was small
    singular = -1;
    for (int k = 0; k < (max_iterations > 0 ? max_iterations : tolerances.itl1); ++k) {
        system.eval(x, instant, memory, sums);
        ++iterations;
        for (std::size_t n = 0; n < nodes && !clamps.g.empty(); ++n) {
            sums.f[n] += clamps.g[n] * (x[n] - clamps.to[n]);
            sums.G[system.pattern().place(static_cast<int>(n), static_cast<int>(n))] += clamps.g[n];
            sums.size[n] = std::max(sums.size[n], clamps.g[n] * std::abs(x[n]));
        }
        if (is_close && !sums.limited && balanced()) return true;
        if (!solver.factor(std::span<const double>(sums.G).first(system.pattern().entries()))) {
            singular = solver.where().column;
            return false;
        }
        for (std::size_t n = 0; n < count; ++n) step[n] = -sums.f[n];
        solver.solve(step);
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

std::string Newton::distance(std::span<const double> x) {
    system.eval(x, instant, memory, sums);
    std::size_t worst = 0;
    double largest = -1;
    for (std::size_t n = 0; n < sums.f.size(); ++n) {
        const double off =
            std::isfinite(sums.f[n]) ? std::abs(sums.f[n]) / (tolerances.reltol * sums.size[n] + sums.grain[n] + tolerances.abstol) : 1e300;
        if (off > largest) largest = off, worst = n;
    }
    const Device* device = nullptr;
    double contribution = -1;
    for (const auto& d : system.devices()) {
        const auto at = std::find(d->unknowns.begin(), d->unknowns.end(), static_cast<int>(worst));
        if (at == d->unknowns.end()) continue;
        const auto v = system.terminals(*d, x);
        const auto n = v.size();
        std::vector<double> stamp(2 * n + 2 * n * n);
        const std::span<double> all(stamp);
        d->eval(v, instant, {all.first(n), all.subspan(n, n), all.subspan(2 * n, n * n), all.subspan(2 * n + n * n)});
        const double f = std::abs(stamp[static_cast<std::size_t>(at - d->unknowns.begin())]);
        if (!(f <= contribution)) contribution = f, device = d.get();
    }
    const bool is_current = worst < static_cast<std::size_t>(system.nodes());
    return fmt::format("largest residual: {1} at {0}{2}", system.names()[worst], format_quantity(sums.f[worst], is_current ? "A" : "V"),
                       device ? fmt::format(", mostly from {}", device->name) : "");
}

}  // namespace corpuscle::circuit
