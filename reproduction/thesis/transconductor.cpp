#include "reproduction/thesis/transconductor.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace corpuscle {

namespace {

/// Half the width of the range around `middle` in which the slope is within 5 % of g_m.
double half_width(const StudyCurve& slope, double middle, double g_m) {
    double from = slope.x.front(), to = slope.x.back();
    for (std::size_t k = 0; k < slope.x.size(); ++k) {
        if (std::abs(slope.y[k] / g_m - 1) <= 0.05) continue;
        if (slope.x[k] < middle) from = slope.x[k];
        if (slope.x[k] > middle) return (slope.x[k] - from) / 2;
    }
    return (to - from) / 2;
}

}  // namespace

Result<TransconductorCurve> simulate_transconductor(StudyNetlist deck, const std::string& out) {
    deck.directives = ".dc vplus 0.15 0.55 0.5m";
    const auto found = run_study_netlist(deck);
    if (!found) return found.error();
    TransconductorCurve t{found->curve("dc", out)};
    for (double& v : t.current.x) v -= 0.35;
    t.zero_current_voltage = t.current.crossing(0);
    const auto slope = t.current.slope().absolute();
    t.g_m = slope.at(t.zero_current_voltage), t.max_current = std::min(t.current.max(), -t.current.min());
    t.linear_range = half_width(slope, t.zero_current_voltage, t.g_m);
    t.power = 0.7 * found->curve("dc", "i(vi)").at(0.35);
    return t;
}

Result<TransconductorCurve> simulate_isolated_pair(double i_b, int columns, int stack) {
    return simulate_transconductor(
        {fmt::format("A differential pair\n.lib '../process/tsmc180.lib' tt\nvdd vdd 0 0.7\nvi vdd supply 0\nib supply t {}\n"
                     "vplus plus 0 0.35\nvminus minus 0 0.35\n"
                     "m1a l plus t vdd pch w=6u l=0.5u m={} stack={}\nm1b r minus t vdd pch w=6u l=0.5u m={} stack={}\n"
                     "vl l 0 0.1\nvr r 0 0.1\n",
                     i_b, columns, stack, columns, stack)},
        "par('i(vr)-i(vl)')");
}

}  // namespace corpuscle
