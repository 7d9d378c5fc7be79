// .tf and .sens: straight lines at 0 Hz.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "circuit/analyses.hpp"
#include "signal/field.hpp"

namespace corpuscle::circuit {
namespace {

struct Line {
    std::vector<double> x;
    Sums sums;
    Solver<double> solver;
};

Result<Line> line_of(TestBench& bench, const Command& c) {
    const auto rest = bench.rest();
    if (!rest) return rest.error();
    Line line{rest->x, sums_at(bench, rest->x), Solver<double>(bench.system.pattern())};
    if (!line.solver.factor(std::span<const double>(line.sums.G).first(bench.system.pattern().entries())))
        return bad_input(fmt::format(".{}: the matrix is singular at the operating point", c.name), c.place);
    return line;
}

void add(std::vector<double>& to, int unknown, double value) {
    if (unknown >= 0) to[static_cast<std::size_t>(unknown)] += value;
}

}  // namespace

Result<Findings> analyse_tf(TestBench& bench, const Command& c) {
    const auto out = wanted_of(bench.system, c, 0);
    if (!out) return out.error();
    if (c.words.size() != 2) return bad_input(fmt::format(".tf: {} words; it is .tf OUTPUT SOURCE", c.words.size()), c.place);
    const auto* source = bench.system.device(c.words[1]);
    if (source == nullptr || !(source->name[0] == 'v' || source->name[0] == 'i'))
        return bad_input(fmt::format(".tf: '{}' is no independent source", c.words[1]), c.place);
    auto line = line_of(bench, c);
    if (!line) return line.error();
    const bool voltage = source->unknowns.size() == 3;
    std::vector<double> by(line->x.size());
    if (voltage)
        add(by, source->unknowns[2], 1);
    else
        add(by, source->unknowns[0], -1), add(by, source->unknowns[1], 1);
    line->solver.solve(by);
    Findings found;
    const auto across = [&](const std::vector<double>& x) {
        return Wanted{source->unknowns[0], source->unknowns[1]}.of(std::span<const double>(x));
    };
    const double in =
        voltage ? (by[static_cast<std::size_t>(source->unknowns[2])] == 0 ? 1e20 : -1 / by[static_cast<std::size_t>(source->unknowns[2])])
                : -across(by);
    std::vector<double> back(line->x.size());
    const bool of_voltage = bench.system.is_voltage(out->plus);
    double resistance = 1e20;
    if (of_voltage) {
        add(back, out->plus, 1), add(back, out->minus, -1);
        line->solver.solve(back);
        resistance = out->of(std::span<const double>(back));
    } else {
        add(back, out->plus, -1);
        line->solver.solve(back);
        const double g = back[static_cast<std::size_t>(out->plus)];
        resistance = g == 0 ? 1e20 : std::abs(1 / g);
    }
    found.numbers = {{"transfer_function", out->of(std::span<const double>(by))},
                     {source->name + "#input_impedance", std::abs(in)},
                     {"output_impedance_at_" + c.words[0], std::abs(resistance)}};
    Plot plot{"Transfer Function", false, false, {}};
    for (const auto& [name, value] : found.numbers) plot.curves.push_back({name, "notype", {value}});
    found.plots.push_back(std::move(plot));
    return found;
}

/// d out / d p = -lambda . df/dp, with G^T lambda = the output's direction; df/dp of one device, by a small change of its value.
Result<Findings> analyse_sens(TestBench& bench, const Command& c) {
    const auto out = wanted_of(bench.system, c, 0);
    if (!out) return out.error();
    auto line = line_of(bench, c);
    if (!line) return line.error();
    std::vector<double> lambda(line->x.size());
    add(lambda, out->plus, 1), add(lambda, out->minus, -1);
    line->solver.solve_transposed(lambda);
    Findings found;
    Plot plot{"Sensitivity Analysis", false, false, {}};
    Instant at;
    at.gmin = bench.tolerances.gmin;
    for (const auto& d : bench.system.devices()) {
        const auto value = d->setting();
        if (!value) continue;
        const auto v = bench.system.terminals(*d, line->x);
        const auto n = v.size();
        const auto flows = [&](double p) {
            std::vector<double> own(2 * n + 2 * n * n);
            const std::span<double> all(own);
            d->set(p);
            d->eval(v, at, {all.first(n), all.subspan(n, n), all.subspan(2 * n, n * n), all.subspan(2 * n + n * n)});
            own.resize(n);
            return own;
        };
        const double h = std::max(std::abs(*value), *value == 0 ? 1.0 : 0.0) * 1e-5;
        const auto up = flows(*value + h), down = flows(*value - h);
        d->set(*value);
        double slope = 0;
        for (std::size_t k = 0; k < n; ++k)
            if (d->unknowns[k] >= 0) slope -= lambda[static_cast<std::size_t>(d->unknowns[k])] * (up[k] - down[k]) / (2 * h);
        found.numbers.emplace_back(d->name, slope);
        plot.curves.push_back({d->name, "notype", {slope}});
    }
    found.plots.push_back(std::move(plot));
    return found;
}

}  // namespace corpuscle::circuit
