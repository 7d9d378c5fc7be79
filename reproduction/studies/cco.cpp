// Statements of section 4.4 on the oscillator: its switching delay, its leak near the supply, its window under body bias.
// Symbols. V_H and V_L are the input voltages at which the trigger switches. The membrane voltage u falls from the supply to V_L, where a
// spike occurs, and is then charged to V_H.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/isolated_oscillator.hpp"

namespace corpuscle::studies::cco {

using O = IsolatedOscillator;
constexpr auto source = "thesis 4.4";

/// Overshoot of the membrane voltage beyond the trigger's window at several currents, and the switching delay that it implies.
Result<void> report_delay(const Hysteresis& t, StudyResult& out) {
    StudyCurve below, above;  // mV over the current in pA: undershoot below V_L, overshoot above V_H
    double delay = 0, overshoot = 0;
    for (const double I : {20e-12, 100e-12, 300e-12, 600e-12, 850e-12}) {
        // long enough for several spikes
        const auto found = simulate_oscillator({.current = I, .stop_time = 20e-3 + 2.25e-12 * 2 / I, .has_high_threshold_switches = true});
        if (!found) return found.error();
        const auto u = found->curve("tran", "v(u)").between(found->number("first_spike") - 1e-3, 1);
        below.x.push_back(1e12 * I), below.y.push_back(1e3 * (t.V_L - u.min()));
        const auto filled = u.between(found->number("first_spike") + 50e-6, 1);
        above.x.push_back(1e12 * I), above.y.push_back(1e3 * (filled.max() - t.V_H));
        if (I > 20e-12) continue;  // the claims are on 20 pA
        // after the spike the membrane is charged, so it rises through 0.35 V
        const double speed = u.slope_at(filled.crossing(0.35));
        overshoot = filled.max() - t.V_H, delay = overshoot / speed;
    }
    out.claim("at 20 pA: overshoot of the charged membrane beyond V_H", overshoot, "V");
    out.claim("at 20 pA: overshoot over the window V_H - V_L", 100 * overshoot / (t.V_H - t.V_L), "%");
    out.claim("at 20 pA: delay of the trigger that causes this overshoot", delay, "s");
    out.claim_true("switching takes time, so the swing is not exactly the window: at 20 pA more than 1 mV beyond V_H", overshoot > 1e-3,
                   source);
    out.claim_true("the faster the membrane falls, the larger the undershoot below V_L", std::is_sorted(below.y.begin(), below.y.end()),
                   source);
    out.claim("at 850 pA: undershoot below V_L", 1e-3 * below.y.back(), "V");
    out.plot("Overshoot beyond the window", "I (pA)", "mV").points("below V_L", below).points("above V_H", above).log_x = true;
    return {};
}

/// The leak current, which pulls the membrane up, over the membrane voltage. Until the next spike it is the only current besides the
/// input's, if the switches do not leak.
Result<void> report_leak(StudyResult& out) {
    const auto found = run_study_netlist({R"(The leak over the membrane voltage, without switches, for 2 and for 200 pA
.lib '../process/tsmc180.lib' tt
vdd vdd 0 0.7
vu u 0 0.7
ilk gl 0 2p
mp1a gl gl vdd vdd pch w=6u l=0.5u m=2 stack=4
mp1b d  gl vdd vdd pch w=6u l=0.5u m=2 stack=4
vd u d 0
ilk2 gl2 0 200p
mp2a gl2 gl2 vdd vdd pch w=6u l=0.5u m=2 stack=4
mp2b d2  gl2 vdd vdd pch w=6u l=0.5u m=2 stack=4
vd2 u d2 0
mp3 off vdd vdd vdd pch w=6u l=0.5u m=2 stack=4
voff off 0 0.35
.dc vu 0.25 0.7 2.5m
)"});
    if (!found) return found.error();
    const auto leak = found->curve("dc", "i(vd)").scaled(1, -1), larger_leak = found->curve("dc", "i(vd2)").scaled(1, -1);
    const double middle = leak.at(0.35), off = found->curve("dc", "i(voff)").absolute().at(0.35);
    out.claim("pull-up current for I_LEAK 2 pA, at 350 mV", middle, "A")
        .published_as(O::I_LEAK, "thesis 4.4, fig. 39")
        .explain(fmt::format("transistors of the size of M1A and M1B carry {:.2f} pA at V_GS = 0. As a diode of 2 pA, M1A is therefore "
                             "within three thermal voltages of the supply and not saturated, while M1B is saturated",
                             1e12 * off));
    out.claim("pull-up current for I_LEAK 200 pA, at 350 mV", larger_leak.at(0.35), "A")
        .derived_as(200e-12, "table 9: the mirror is 1 to 1");
    const auto remainder = [&](const StudyCurve& line, double below) { return 100 * line.at(0.7 - below) / line.at(0.35); };
    for (const double below : {100e-3, 50e-3, 25e-3, 10e-3})
        out.claim(fmt::format("leak {:.0f} mV below the supply over that at 350 mV", 1e3 * below), remainder(leak, below), "%");
    const double g = leak.at(0.7 - 10e-3) / 10e-3;
    out.claim_true("100 mV below the supply the leak is within a tenth of its value at 350 mV, 25 mV below the supply it is not",
                   std::abs(remainder(leak, 100e-3) - 100) < 10 && std::abs(remainder(leak, 25e-3) - 100) > 10, source);
    out.claim("resistance of the leak close to the supply", 1 / g, "ohm");
    const double linearity = leak.at(0.7 - 5e-3) / 5e-3 / g;
    out.claim("change of the leak's conductance between 5 and 10 mV below the supply", 100 * std::abs(linearity - 1), "%")
        .allow_max(20, "thesis 4.4: the leak behaves as a resistor; a fifth is our choice");
    out.plot("The leak as the membrane nears the supply", "u (V)", "pA")
        .describe_published("constant, then resistive")
        .add("I_LEAK 2 pA", leak.scaled(1, 1e12));
    return {};
}

/// The trigger with separate bulk nodes: N bulks are above VSS and P bulks below VDD by the voltage `all`; for the devices in feedback, M3B
/// and M4B, by `all` plus `feedback`.
constexpr auto netlist = R"(The trigger's window under forward body bias
.lib '../process/tsmc180.lib' tt
.param all=0 feedback=0
vdd vdd 0 0.7
vin in 0 0
vn bn 0 {all}
vp bp 0 {0.7-all}
vnf bnf 0 {all+feedback}
vpf bpf 0 {0.7-all-feedback}
m3c p   in  vdd bp  pch w=6u l=0.5u m=2 stack=4
m3a out in  p   bp  pch w=6u l=0.5u m=16
m3b 0   out p   bpf pch w=6u l=0.5u m=8
m4c n   in  0   bn  nch w=1.5u l=0.5u m=2 stack=4
m4a out in  n   bn  nch w=1.5u l=0.5u m=16
m4b vdd out n   bnf nch w=1.5u l=0.5u m=8
.dc vin 0 0.7 1m updown
)";

Result<void> report_body_bias(const Hysteresis& t, StudyResult& out) {
    StudyPlot& plot = out.plot("The window under forward body bias", "forward body bias (V)", "threshold (V)");
    for (const auto& [name, parameter] : {std::pair{"all six devices", "all"}, {"the feedback devices", "feedback"}}) {
        StudyCurve high, low;
        for (const double bias : {0.0, 0.1, 0.2, 0.3, 0.37}) {
            const auto found = run_study_netlist({netlist, {fmt::format("{}={}", parameter, bias)}});
            if (!found) return found.error();
            const auto h = find_hysteresis(*found, "v(out)");
            high.x.push_back(bias), high.y.push_back(h.V_H), low.x.push_back(bias), low.y.push_back(h.V_L);
        }
        const double window = 100 * ((high.y.back() - low.y.back()) / (t.V_H - t.V_L) - 1);
        out.claim(fmt::format("forward body bias of 370 mV, as in the transconductors, on {}: change of the window V_H - V_L", name),
                  window, "%");
        out.claim(fmt::format("change of V_H, body bias on {}", name), high.y.back() - t.V_H, "V"),
            out.claim(fmt::format("change of V_L, body bias on {}", name), low.y.back() - t.V_L, "V");
        if (name == std::string_view("the feedback devices"))
            out.claim_true("forward body bias of the feedback devices changes the window by at least a tenth", std::abs(window) > 10,
                           source);
        plot.add(fmt::format("V_H, {}", name), high).add(fmt::format("V_L, {}", name), low);
    }
    return {};
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    const auto t = simulate_trigger();
    if (!t) return t.error();
    if (auto ok = report_delay(*t, out); !ok) return ok.error();
    if (auto ok = options.report_progress(0.5); !ok) return ok.error();
    if (auto ok = report_leak(out); !ok) return ok.error();
    if (auto ok = report_body_bias(*t, out); !ok) return ok.error();
    return out;
}

const Study study{"cco", "The oscillator's delay, leak and window",
                  "A switching delay extends the swing beyond the window; the leak becomes a resistor near the supply; body bias controls "
                  "the window. Thesis 4.4",
                  compute};

}  // namespace corpuscle::studies::cco
