// .ac: the response of the circuit, linearized at its operating point, to the AC values of its sources.

#include "circuit/analyses.hpp"

#include <fmt/format.h>

namespace corpuscle::circuit {

Result<AnalysisResult> analyse_ac(AnalysisContext& context, const Directive& c) {
    const auto frequencies = TRY(read_frequencies(c, 0));
    const auto operating_point = TRY(context.operating_point());
    const auto& system = context.system;
    const auto evaluation = evaluate_operating_point(context, operating_point.x);
    std::vector<std::complex<double>> stimulus(static_cast<std::size_t>(system.size()));
    for (const auto& d : system.devices()) {
        std::vector<std::complex<double>> contribution(d->unknowns.size());
        d->add_ac_stimulus(contribution);
        for (std::size_t k = 0; k < contribution.size(); ++k)
            if (d->unknowns[k] >= 0) stimulus[static_cast<std::size_t>(d->unknowns[k])] += contribution[k];
    }
    AnalysisResult result;
    Plot plot = make_plot(system, "AC Analysis", "frequency", "frequency");
    plot.is_complex = true;
    LinearSolver<std::complex<double>> solver(system.pattern());
    for (const double f : frequencies) {
        if (context.is_stopped(static_cast<double>(plot.point_count()) / static_cast<double>(frequencies.size())))
            return interrupted_error();
        const auto values = admittances(evaluation, system.pattern().entries(), 6.283185307179586 * f);
        if (!solver.factor(values)) {
            const int unknown = solver.singularity().column;
            return bad_input(fmt::format(".ac at {:g} Hz: the matrix is singular{}", f,
                                         unknown < 0 ? "" : " at " + system.names()[static_cast<std::size_t>(unknown)]),
                             c.location);
        }
        auto x = stimulus;
        solver.solve(x);
        append(plot, f, std::span<const std::complex<double>>(x));
    }
    result.plots.push_back(std::move(plot));
    return result;
}

}  // namespace corpuscle::circuit
