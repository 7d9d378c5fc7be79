// .ac: the response of the circuit, linearized at its operating point, to the AC values of its sources.

#include "circuit/analysis/analysis_context.hpp"

namespace corpuscle::circuit {
namespace {

Plot expected_ac_plot(const System& system, const Directive&) {
    auto plot = make_plot(system, "AC Analysis", "frequency", "frequency");
    return plot.is_complex = true, plot;
}

Result<AnalysisResult> analyse_ac(AnalysisContext& context, const Directive& c) {
    const auto frequencies = TRY(read_frequencies(c, 0));
    const auto operating_point = TRY(context.operating_point());
    const auto& system = context.system;
    std::vector<std::complex<double>> stimulus(static_cast<std::size_t>(system.size()));
    for (const auto& d : system.devices()) {
        std::vector<std::complex<double>> contribution(d->unknowns.size());
        d->add_ac_stimulus(contribution);
        for (std::size_t k = 0; k < contribution.size(); ++k)
            if (d->unknowns[k] >= 0) stimulus[static_cast<std::size_t>(d->unknowns[k])] += contribution[k];
    }
    AnalysisResult result{.plots = {expected_ac_plot(system, c)}};
    TRY(for_each_frequency(context, c, evaluate_operating_point(context, operating_point.x), frequencies,
                           [&](double f, const auto& solver) {
                               auto x = stimulus;
                               solver.solve(x);
                               append(result.plots[0], f, x);
                           }));
    return result;
}

}  // namespace

extern constexpr Analysis ac_analysis = {.name = "ac",
                                         .usage = ".ac dec|oct|lin POINTS FROM TO",
                                         .description = "small-signal response over frequency",
                                         .run = analyse_ac,
                                         .expected_plot = expected_ac_plot,
                                         .ngspice_order = 1};

}  // namespace corpuscle::circuit
