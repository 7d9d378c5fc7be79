// Kim et al. 2012: intervals between spikes of mouse SA-I afferents under ramp and hold, published with their standard deviations. The
// model's equation is published (thesis eq. 1), its parameters are not. Two of them, beta and k_s, are fitted here to three intervals of
// the hold.

#include <fmt/format.h>

#include "core/number/elementary.hpp"
#include "measure/measures.hpp"
#include "reproduction/claims/studies.hpp"
#include "reproduction/claims/trial.hpp"

namespace corpuscle::studies::kim {

struct Hold {
    double depth, interval, spread;  ///< mm; s, published mean; s, its standard deviation
};
constexpr Hold holds[] = {{1.2, 98.8e-3, 24.7e-3}, {1.3, 54.5e-3, 6.9e-3}, {1.4, 41.1e-3, 6.1e-3}};
constexpr double ramps[] = {21.9e-3, 20.0e-3, 15.4e-3};  // s: published intervals during three ramps, from the slowest to the fastest
constexpr auto source = "Kim et al. 2012, abstract";

// LIF-A with the defaults of the catalogue: V_th 0.5 V, V_reset 0.25 V, R_m 1 Mohm, C_m 500 nF.
constexpr double V_th = 0.5, V_reset = 0.25, R_m = 1e6, tau_m = 0.5;

/// The current (A) at which LIF-A fires at this interval.
double current_for(double interval) {
    const double e = num::exp(interval / tau_m);
    return (V_th * e - V_reset) / (e - 1) / R_m;
}

/// The straight line through the currents of the three depths, by least squares: {A at depth 0, A/mm}.
std::pair<double, double> fit_current() {
    double depth = 0, current = 0, product = 0, square = 0;
    for (const auto& h : holds) depth += h.depth / 3, current += current_for(h.interval) / 3;
    for (const auto& h : holds)
        product += (h.depth - depth) * (current_for(h.interval) - current), square += (h.depth - depth) * (h.depth - depth);
    return {current - product / square * depth, product / square};
}

Result<StudyResult> compute(const StudyOptions&) {
    StudyResult out;
    const auto [beta, slope] = fit_current();
    const double contact = -beta / slope;  // mm: the depth at which the fitted current is zero
    StudyPlot plot{"Interval in the hold",
                   "depth (mm)",
                   "interval (ms)",
                   {{"published", {}, {}, StudyPlot::Style::points}, {"computed", {}, {}, StudyPlot::Style::line}}};
    for (const auto& h : holds) {
        const double F = h.depth - contact;  // 1 N represents a millimetre beyond contact
        const auto train = simulate_train({"sa1a+lif-a",
                                           "ramp-hold",
                                           {fmt::format("sa1a+lif-a.k_s={}", slope), "sa1a+lif-a.beta=0", "sa1a+lif-a.k_d=0",
                                            fmt::format("ramp-hold.F_max={}", F), "ramp-hold.t_hold=5"}});
        if (!train) return train.error();
        const double computed = 1 / measure<LastRate>(*train, {1, 5.35});
        out.claim(fmt::format("interval in the hold at {} mm", h.depth), computed, "s")
            .published_as(h.interval, source)
            .allow_range(h.interval - h.spread, h.interval + h.spread, source);
        plot.series[0].x.push_back(h.depth), plot.series[0].y.push_back(1e3 * h.interval);
        plot.series[1].x.push_back(h.depth), plot.series[1].y.push_back(1e3 * computed);
    }
    // Assumes that the ramps end at the deepest hold and that their intervals are those at mid-ramp, with half of the hold's static
    // current.
    const double hold_current = beta + slope * holds[2].depth;
    const double first = current_for(ramps[0]) - hold_current / 2;  // A: dynamic current of the first ramp, proportional to its slope
    for (const double ramp : ramps)
        out.claim(fmt::format("slope of the ramp that gives an interval of {:.1f} ms, over that of the first ramp", 1e3 * ramp),
                  (current_for(ramp) - hold_current / 2) / first)
            .explain("the abstract does not give the ramps");
    out.plots.push_back(std::move(plot));
    out.notes = {
        fmt::format("A current linear in depth (contact at {:.3f} mm, {:.3g} A/mm) gives all three intervals within their "
                    "published standard deviations: two parameters fitted to three values.",
                    contact, slope),
        "The ramps cannot be checked: their speeds are not published with the intervals. One k_d fits one of their intervals; the others "
        "only give the required ratio of the speeds.",
        "The abstract does not say which intervals are the model's and which are the mouse's."};
    return out;
}

const Study study{"kim", "Kim's ramp and hold",
                  "Can the equation reproduce the published intervals? Kim et al. 2012, doi 10.1186/1743-0003-9-45", compute};

}  // namespace corpuscle::studies::kim
