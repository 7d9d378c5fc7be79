// Fig. 34: SA-I's analog signal processing under the press stimulus: the currents of its three paths.
// Symbols. I_F is the transducer's output current, V_F the voltage made of it, V_HPB and V_HPC are the outputs of the high-pass filters.
// I_A is the static component, I_B and I_C are the rectified currents of the filters, I is the sum of all three.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/chip_vs_model.hpp"
#include "reproduction/thesis/isolated_oscillator.hpp"

namespace corpuscle::studies::fig34 {

constexpr auto source = "thesis 4.3.1";
constexpr double at_rest = 0.2, at_hold = 0.6, mid_rise = 0.3125;  // s: times of the press stimulus: at 0.2 N, at 4 N, steepest rise
constexpr double step = 0.5e-3;  // s, step at which currents are resampled, so that pulses of microseconds drop out

/// Claims on V_F and the static component I_A.
void report_static(const NetlistResult& found, StudyResult& out) {
    const auto V_F = found.curve("tran", "v(vf)"), I_A = found.curve("tran", "i(via)");
    const auto I_F = found.curve("tran", "i(xccvs.mp3a)").absolute();
    out.claim("I_F at 0.2 N", I_F.at(at_rest), "A"), out.claim("I_F at 4 N", I_F.at(at_hold), "A");
    out.claim("V_F at 0.2 N", V_F.at(at_rest), "V"), out.claim("V_F at 4 N", V_F.at(at_hold), "V");
    out.claim_true("V_F stays where its transconductor is linear, 300 to 500 mV", V_F.min() >= 0.3 && V_F.max() <= 0.5,
                   "thesis 4.3.1, fig. 28")
        .explain(fmt::format("I_F / 2 - I_BIASF rises from {:.0f} to {:.0f} nA with these sizes and V_Y = 0.1 V, while 150 mV over the "
                             "published 413 kohm need {:.0f} nA; beyond that V_F is compressed",
                             1e9 * (I_F.at(at_rest) / 2 - 700e-9), 1e9 * (I_F.at(at_hold) / 2 - 700e-9), 150e-3 / 413e3 * 1e9));
    out.claim("I_A at 4 N", I_A.at(at_hold), "A"), out.claim("I_A at 0.2 N", I_A.at(at_rest), "A");
    const double fraction = I_A.at(at_rest) / I_A.at(at_hold), expected = I_F.at(at_rest) / I_F.at(at_hold);
    out.claim("I_A is proportional to I_F: I_A at 0.2 N as a fraction of I_A at 4 N", 100 * fraction, "%")
        .derived_as(100 * expected, source);
}

/// Claims on a rectified component: its largest value and when it occurs, its value at rest, and the effects of its switch. `enable` is the
/// comparator's output, which is high while the switch is closed.
void report_dynamic(const NetlistResult& found, const std::string& name, const char* curve, const char* enable, StudyResult& out) {
    const auto all = found.curve("tran", curve), I = all.resampled(step), en = found.curve("tran", enable);
    const auto rise = I.between(0.26, 0.5);
    out.claim(name + ": largest value", rise.max(), "A"),
        out.claim(name + ": delay of its peak after the steepest point of the ramp", rise.x_of_max() - mid_rise, "s");
    out.claim(name + ": value at 0.2 s, at rest", I.at(at_rest), "A")
        .allow_range(-0.1e-12, 0.1e-12, "thesis 4.3.1, eq. 4 and 8: otherwise I_X = 0; 0.1 pA is our choice");
    auto& not_negative = out.claim_true(name + " is never negative", I.min() >= -0.1e-12, "thesis 4.3.1, max{I_X, 0}");
    const double opening = en.between(0.63, 1).crossing(0.35);  // s; the force falls from 0.625 s on
    if (not_negative.needs_explanation())
        not_negative.explain(fmt::format(
            "while its switch is closed it outputs the leakage of M5A as a negative current ({:.1f} pA at 620 ms). The comparator has to "
            "charge capacitances with picoamperes, so it opens the switch only {:.0f} ms after the force begins to fall; the lowest "
            "current is {:.1f} pA",
            1e12 * I.at(0.62), 1e3 * (opening - 0.625), 1e12 * I.min()));
    const double closing = en.crossing(0.35, 0.25);
    out.claim(name + ": largest glitch when its switch closes (lasts microseconds)",
              all.between(closing - 1e-3, closing + 1e-3).absolute().max(), "A");
    out.claim(name + ": largest glitch when its switch opens", all.between(opening - 1e-3, opening + 1e-3).absolute().max(), "A");
    out.claim(name + ": value 25 ms after its switch has opened", I.at(opening + 25e-3), "A")
        .allow_range(-0.1e-12, 0.1e-12, "thesis 4.3.1: the switch is open");
}

/// The largest change (A) of a current in 10 us at the start of the ramp.
double largest_step(const StudyCurve& line) {
    const auto even = line.between(0.25, 0.3).resampled(10e-6);
    double largest = 0;
    for (std::size_t k = 1; k < even.y.size(); ++k) largest = std::max(largest, std::abs(even.y[k] - even.y[k - 1]));
    return largest;
}

/// The filter outputs at which the comparator of I_B's rectifier closes and opens the switch.
Result<void> report_comparator(StudyResult& out) {
    const auto found = run_study_netlist({R"(The comparator of I_B's rectifier
.lib '../process/tsmc180.lib' tt
.include 'parts/transconductor.inc'
.include 'parts/trigger.inc'
.include 'parts/signal.inc'
vdd vdd 0 0.7
xbias vdd pgb bp bn bias
ibb pgb 0 200n
vu u 0 0.35
vhp hp 0 0.35
xres hp hp gp gn vdd bp bn invc
xb gp gn u vdd rectifier_sa
.dc vhp 0.347 0.354 0.1m updown
)"});
    if (!found) return found.error();
    const auto en = find_hysteresis(*found, "v(xb.en)");
    out.claim("comparator: closes the switch at a filter output of", en.V_H, "V"),
        out.claim("comparator: opens the switch at a filter output of", en.V_L, "V");
    out.claim("comparator: hysteresis", en.V_H - en.V_L, "V")
        .allow_range(0.1e-3, 10e-3, "thesis 4.3.1: a small hysteresis; 0.1 to 10 mV, compared with signals of 30 to 200 mV, is our choice");
    return {};
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    const auto found = run_study_netlist(
        {"asp_sa1",
         {},
         ".save v(vf) v(hpb) v(hpc) i(vi) i(via) i(vib) i(vic) v(xrectb.en) v(xrectc.en) i(xccvs.mp3a)\n.op\n.tran 1m 1 0 5m"});
    if (!found) return found.error();
    if (auto ok = options.report_progress(0.5); !ok) return ok.error();
    report_static(*found, out);
    report_dynamic(*found, "I_B", "i(vib)", "v(xrectb.en)", out);
    report_dynamic(*found, "I_C", "i(vic)", "v(xrectc.en)", out);
    const auto I_B = found->curve("tran", "i(vib)").resampled(step), I_C = found->curve("tran", "i(vic)").resampled(step);
    out.claim_true(
        "I_B ends with the ramp and I_C decays through the plateau: at 420 ms I_B is below a tenth of its largest value, I_C above",
        I_B.at(0.42) < 0.1 * I_B.max() && I_C.at(0.42) > 0.1 * I_C.max(), "thesis 3.3, fig. 17a, which this circuit implements");
    const auto I = found->curve("tran", "i(vi)").resampled(step), I_A = found->curve("tran", "i(via)").resampled(step);
    out.claim("I: largest value", I.max(), "A");
    if (auto ok = report_comparator(out); !ok) return ok.error();
    StudyPlot& a =
        out.plot("34a, voltages", "time (s)", "V")
            .describe_published(
                "V_F, V_HPB (printed as V_HPA) and V_HPC (printed as V_HPB) under the press stimulus; the text gives no details");
    for (const auto& [name, curve] : {std::pair{"V_F", "v(vf)"}, {"V_HPB", "v(hpb)"}, {"V_HPC", "v(hpc)"}})
        a.add(name, found->curve("tran", curve));
    StudyPlot& b = out.plot("34b, currents", "time (s)", "pA").describe_published("I_A, I_B and I_C, whose sum is I");
    b.add("I_A", I_A.scaled(1, 1e12)).add("I_B", I_B.scaled(1, 1e12)).add("I_C", I_C.scaled(1, 1e12)).add("I", I.scaled(1, 1e12));
    out.claim_true(
        "I has a glitch when the rectifiers switch, I_A has none: the largest step of I_A in 10 us is less than a tenth of I_B's",
        largest_step(found->curve("tran", "i(via)")) < 0.1 * largest_step(found->curve("tran", "i(vib)")), "thesis 4.4, errata S18");
    out.note(
        "As in circuits/asp_sa1.cir: 0.7 V, I_BIASB 200 nA, I_BIASF 700 nA, 27 C, typical, as published; the membrane is held at half the "
        "supply. Gains as intended (errata S9a, S10a). The numbers of the figure are not in the text; the claims come from the text.");
    return out;
}

const Study study{"fig34", "SA-I's analog signal processing under the press stimulus",
                  "V_F, V_HPB, V_HPC, and I_A, I_B, I_C with their sum I. Thesis 4.3.1, fig. 34", compute};

}  // namespace corpuscle::studies::fig34
