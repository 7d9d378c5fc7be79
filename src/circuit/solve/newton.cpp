#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "circuit/solve/operating_point.hpp"
#include "signal/quantity.hpp"

namespace corpuscle::circuit {
namespace {

/// How far a node may go in one step: as far as the sources reach, and no less than 0.3 V.
double reach(const System& system) {
    double most = 0.3;
    const auto& elements = system.circuit().elements;
    for (std::size_t k = 0; k < elements.size(); ++k)
        if (elements[k].letter == 'v') most = std::max(most, std::abs(system.devices()[k]->setting().value_or(0)) / 2);
    return most;
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

bool Newton::run(std::vector<double>& x, const Springs& springs, int most) {
    const auto count = static_cast<std::size_t>(system.size()), nodes = static_cast<std::size_t>(system.nodes());
    const bool linear = system.linear();
    const double cap = linear ? 0 : reach(system);
    bool close = false;  // the last step was small
    singular = -1;
    for (int k = 0; k < (most > 0 ? most : tolerances.itl1); ++k) {
        system.eval(x, instant, memory, sums);
        ++iterations;
        for (std::size_t n = 0; n < nodes && !springs.g.empty(); ++n) {
            sums.f[n] += springs.g[n] * (x[n] - springs.to[n]);
            sums.G[system.pattern().place(static_cast<int>(n), static_cast<int>(n))] += springs.g[n];
            sums.size[n] = std::max(sums.size[n], springs.g[n] * std::abs(x[n]));
        }
        if (close && !sums.limited && balanced()) return true;
        if (!solver.factor(std::span<const double>(sums.G).first(system.pattern().entries()))) {
            singular = solver.where().column;
            return false;
        }
        for (std::size_t n = 0; n < count; ++n) step[n] = -sums.f[n];
        solver.solve(step);
        if (!std::all_of(step.begin(), step.end(), [](double d) { return std::isfinite(d); })) return false;
        double largest = 0;  // current
        for (std::size_t n = 0; n < count; ++n)
            if (!system.is_voltage(static_cast<int>(n))) largest = std::max(largest, std::abs(x[n]));
        close = true;
        for (std::size_t n = 0; n < count; ++n) {
            const bool voltage = system.is_voltage(static_cast<int>(n));
            if (voltage && cap > 0 && std::abs(step[n]) > cap) step[n] = std::copysign(cap, step[n]);
            const double floor = voltage ? tolerances.vntol : tolerances.abstol + 1e-13 * largest;
            close &= std::abs(step[n]) <= tolerances.reltol * std::max(std::abs(x[n]), std::abs(x[n] + step[n])) + floor;
            x[n] += step[n];
        }
    }
    return false;
}

std::string Newton::distance(std::span<const double> x) {
    system.eval(x, instant, memory, sums);
    std::size_t worst = 0;
    double most = -1;
    for (std::size_t n = 0; n < sums.f.size(); ++n) {
        const double off =
            std::isfinite(sums.f[n]) ? std::abs(sums.f[n]) / (tolerances.reltol * sums.size[n] + sums.grain[n] + tolerances.abstol) : 1e300;
        if (off > most) most = off, worst = n;
    }
    const Device* device = nullptr;
    double share = -1;
    for (const auto& d : system.devices()) {
        const auto at = std::find(d->unknowns.begin(), d->unknowns.end(), static_cast<int>(worst));
        if (at == d->unknowns.end()) continue;
        const auto v = system.terminals(*d, x);
        const auto n = v.size();
        std::vector<double> own(2 * n + 2 * n * n);
        const std::span<double> all(own);
        d->eval(v, instant, {all.first(n), all.subspan(n, n), all.subspan(2 * n, n * n), all.subspan(2 * n + n * n)});
        const double f = std::abs(own[static_cast<std::size_t>(at - d->unknowns.begin())]);
        if (!(f <= share)) share = f, device = d.get();
    }
    const bool current = worst < static_cast<std::size_t>(system.nodes());
    return fmt::format("worst at {}: {} is left over there{}", system.names()[worst], format_quantity(sums.f[worst], current ? "A" : "V"),
                       device ? fmt::format(", most by {}", device->name) : "");
}

}  // namespace corpuscle::circuit
