// .size: the number of unknowns of the circuit's equations.

#include "circuit/analysis/analysis_context.hpp"

namespace corpuscle::circuit {
namespace {

Plot expected_size_plot(const System&, const Directive&) { return {"Size", false, false, {{"unknowns", "notype", {}}}}; }

Result<AnalysisResult> analyse_size(AnalysisContext& context, const Directive& c) {
    if (!c.words.empty()) return error_at(c.location_of(0), ".size: it has no arguments");
    AnalysisResult result;
    result.numbers = {{"unknowns", context.system.size()}};
    result.plots.push_back(expected_size_plot(context.system, c));
    result.plots[0].curves[0].values = {result.numbers[0].second};
    return result;
}

}  // namespace

extern constexpr Analysis size_analysis = {.name = "size",
                                           .usage = ".size",
                                           .description = "the number of unknowns of the equations",
                                           .run = analyse_size,
                                           .expected_plot = expected_size_plot,
                                           .has_number_for_each_curve = true};

}  // namespace corpuscle::circuit
