#include "reproduction/thesis/bias/bias_figure.hpp"

#include <fmt/format.h>
#include <cmath>

namespace corpuscle {
namespace {

/// Adds a claim on the start or the end of a working range, and explains what limits the generator there. `end` and `reaches_sweep_end`: as
/// in explain_range_end.
Result<void> claim_end(StudyResult& out, const std::string& claim_label, const BiasSweep& sweep, double end, bool reaches_sweep_end,
                       double published, const BiasFigure& figure) {
    auto why = TRY(explain_range_end(sweep, end, reaches_sweep_end));
    auto& claim = out.claim(claim_label, end, figure.unit);
    claim.published_as(published, figure.source());
    claim.explain(why + (claim.needs_explanation() ? ". No one width of the arrays gives all published ranges (study bias-valid)" : ""));
    // the published range may be longer than its figure, so the generator must only work where the figure begins
    if (published == figure.axis_start) claim.allow_max(published, figure.source() + ", which begins there");
    return {};
}

Result<void> claim_ranges(const BiasFigure& figure, std::span<const BiasCorner> corners, StudyResult& out) {
    const auto& typical = corners[0];  // simulate_bias_figure begins with tt
    if (auto ok = claim_end(out, "typical: works from", typical.sweep, typical.working_range.from,
                            typical.working_range.reaches_sweep_start, figure.typical_range[0], figure);
        !ok)
        return ok;
    if (auto ok = claim_end(out, "typical: works to", typical.sweep, typical.working_range.to, typical.working_range.reaches_sweep_end,
                            figure.typical_range[1], figure);
        !ok)
        return ok;
    if (std::isnan(figure.corner_range[0])) return {};
    const BiasCorner *limits_start = corners.data(), *limits_end = limits_start;  // the corners whose range starts last and ends first
    for (const auto& c : corners) {
        if (c.working_range.from > limits_start->working_range.from) limits_start = &c;
        if (c.working_range.to < limits_end->working_range.to) limits_end = &c;
    }
    const auto label = [](const char* end, const BiasCorner& c) {
        return fmt::format("all corners: works {} (limited by {})", end, c.name);
    };
    if (auto ok = claim_end(out, label("from", *limits_start), limits_start->sweep, limits_start->working_range.from,
                            limits_start->working_range.reaches_sweep_start, figure.corner_range[0], figure);
        !ok)
        return ok;
    return claim_end(out, label("to", *limits_end), limits_end->sweep, limits_end->working_range.to,
                     limits_end->working_range.reaches_sweep_end, figure.corner_range[1], figure);
}

void add_plots(const BiasFigure& figure, std::span<const BiasCorner> corners, StudyResult& out) {
    const bool log = figure.axis == BiasAxis::current;
    auto& voltages = out.plot(fmt::format("Fig. {}a: body voltages, typical", figure.number), figure.x_label, "V");
    voltages.log_x = log;
    for (const auto& [node, name] : {std::pair{"v(bn)", "V_BN"}, {"v(bp)", "V_BP"}, {"v(ref)", "V_REF"}, {"v(q)", "V_Q"}})
        voltages.add(name, corners[0].sweep.curve(node).scaled(figure.plot_scale, 1));
    auto& currents = out.plot(fmt::format("Fig. {}b: I_Q in the corners", figure.number), figure.x_label, "I_Q (nA)");
    currents.log_x = currents.log_y = log;
    for (const auto& c : corners) currents.add(c.name, c.sweep.I_Q().scaled(figure.plot_scale, 1e9));
    if (log) currents.add("I_Q = I_BIAS", {{10, 3000}, {10, 3000}});
    auto& errors =
        out.plot("Error over its margin (V_Q: 5 mV, I_Q: a tenth of I_BIAS), the larger of the two", figure.x_label, "error over margin");
    errors.log_x = log, errors.log_y = true;
    for (const auto& c : corners) errors.add(c.name, c.sweep.worst_error().scaled(figure.plot_scale, 1));
    errors.add("limit",
               {{corners[0].sweep.worst_error().x.front() * figure.plot_scale, corners[0].sweep.worst_error().x.back() * figure.plot_scale},
                {1, 1}});
}

}  // namespace

Result<std::string> explain_range_end(const BiasSweep& sweep, double end, bool reaches_sweep_end) {
    auto settings = sweep.settings;
    settings.push_back(bias_setting(sweep.axis, end));
    const auto state = TRY(simulate_bias_state(settings));
    if (reaches_sweep_end) return "works where the sweep begins or ends; " + state.description();
    const bool current_is_worse = sweep.current_error().at(end) > sweep.voltage_error().at(end);
    return fmt::format("{} leaves its margin; {}", current_is_worse ? "I_Q" : "V_Q", state.description());
}

Result<std::vector<BiasCorner>> simulate_bias_figure(const BiasFigure& figure, StudyResult& out, const StudyOptions& options) {
    std::vector<BiasCorner> corners;
    for (const char* name : {"tt", "ss", "ff"}) {
        auto sweep = TRY(BiasSweep::run(figure.axis, {fmt::format("corner={}", name)}));
        const auto range = sweep.working_range();
        corners.push_back({name, std::move(sweep), range});
        TRY(options.report_progress(static_cast<double>(corners.size()) / 4));
    }
    TRY(claim_ranges(figure, corners, out));
    add_plots(figure, corners, out);
    return corners;
}

}  // namespace corpuscle
