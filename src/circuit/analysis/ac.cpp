// .ac: the circuit as a straight line about its operating point, driven by its sources' AC values.

#include "circuit/analyses.hpp"

#include <fmt/format.h>

namespace corpuscle::circuit {

Result<Findings> analyse_ac(TestBench& bench, const Command& c) {
    const auto frequencies = frequencies_of(c, 0);
    if (!frequencies) return frequencies.error();
    const auto rest = bench.rest();
    if (!rest) return rest.error();
    const auto& system = bench.system;
    const auto sums = sums_at(bench, rest->x);
    std::vector<std::complex<double>> drive(static_cast<std::size_t>(system.size()));
    for (const auto& d : system.devices()) {
        std::vector<std::complex<double>> own(d->unknowns.size());
        d->drive(own);
        for (std::size_t k = 0; k < own.size(); ++k)
            if (d->unknowns[k] >= 0) drive[static_cast<std::size_t>(d->unknowns[k])] += own[k];
    }
    Findings out;
    Plot plot = plot_of(system, "AC Analysis", "frequency", "frequency");
    plot.is_complex = true;
    Solver<std::complex<double>> solver(system.pattern());
    for (const double f : *frequencies) {
        if (bench.stopped(static_cast<double>(plot.points()) / static_cast<double>(frequencies->size()))) return interruption();
        const auto values = admittances(sums, system.pattern().entries(), 6.283185307179586 * f);
        if (!solver.factor(values)) {
            const int at = solver.where().column;
            return bad_input(fmt::format(".ac at {:g} Hz: the matrix is singular{}", f,
                                         at < 0 ? "" : " at " + system.names()[static_cast<std::size_t>(at)]),
                             c.place);
        }
        auto x = drive;
        solver.solve(x);
        append(plot, f, std::span<const std::complex<double>>(x));
    }
    out.plots.push_back(std::move(plot));
    return out;
}

}  // namespace corpuscle::circuit
