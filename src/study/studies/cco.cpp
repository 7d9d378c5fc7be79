// What section 4.4 says of the oscillator in words: its switching delay, its leak near the supply, its window under body bias.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "study/studies.hpp"
#include "study/thesis/oscillator_alone.hpp"

namespace corpuscle::studies::cco {

using O = OscillatorAlone;
constexpr auto source = "thesis 4.4";

/// How far beyond its window the membrane goes, against how fast it gets there.
Result<void> tell_delay(const Hysteresis& t, Outcome& out) {
    Line below, above;
    double delay = 0, beyond = 0;
    for (const double I : {20e-12, 100e-12, 300e-12, 600e-12, 850e-12}) {
        const auto found = driven({.current = I, .until = 20e-3 + 2.25e-12 * 2 / I, .better_switches = true});
        if (!found) return found.error();
        const auto u = found->line("tran", "v(u)").between(found->number("first_spike") - 1e-3, 1);
        below.x.push_back(1e12 * I), below.y.push_back(1e3 * (t.V_L - u.least()));
        const auto filled = u.between(found->number("first_spike") + 50e-6, 1);
        above.x.push_back(1e12 * I), above.y.push_back(1e3 * (filled.most() - t.V_H));
        if (I > 20e-12) continue;
        const double speed = u.slope_at(filled.where(0.35));
        beyond = filled.most() - t.V_H, delay = beyond / speed;
    }
    out.claim("at 20 pA the filled membrane goes beyond V_H by", beyond, "V");
    out.claim("... of the window", 100 * beyond / (t.V_H - t.V_L), "%");
    out.claim("... which is a delay of the trigger of", delay, "s");
    out.finds("the thresholds are not exactly the window's, for switching takes time: at 20 pA more than 1 mV beyond V_H", beyond > 1e-3,
              source);
    out.finds("the faster the membrane falls, the farther below V_L it goes", std::is_sorted(below.y.begin(), below.y.end()), source);
    out.claim("at 850 pA it falls below V_L by", 1e-3 * below.y.back(), "V");
    out.plot("Beyond the window", "I (pA)", "mV").points("below V_L", below).points("above V_H", above).log_x = true;
    return {};
}

/// What pulls the membrane up, held at a voltage while the trigger waits for it to fall.
Result<void> tell_leak(Outcome& out) {
    const auto found = found_in({R"(The leak along the membrane's voltage, with no switch, for 2 and for 200 pA
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
    const auto leak = found->line("dc", "i(vd)").times(1, -1), more = found->line("dc", "i(vd2)").times(1, -1);
    const double middle = leak.at(0.35), off = found->line("dc", "i(voff)").absolute().at(0.35);
    out.claim("2 pA of I_LEAK pull up, at 350 mV", middle, "A")
        .printed_as(O::I_LEAK, "thesis 4.4, fig. 39")
        .because(fmt::format(
            "M1A and M1B let {:.2f} pA through with V_GS = 0, so that M1A, as a diode of 2 pA, is within three thermal voltages of the "
            "supply and not saturated, while M1B is",
            1e12 * off));
    out.claim("200 pA pull up", more.at(0.35), "A").held_to(200e-12, "1:1, table 9");
    const auto rest = [&](const Line& line, double below) { return 100 * line.at(0.7 - below) / line.at(0.35); };
    for (const double below : {100e-3, 50e-3, 25e-3, 10e-3})
        out.claim(fmt::format("left of it {:.0f} mV below the supply", 1e3 * below), rest(leak, below), "%");
    const double g = leak.at(0.7 - 10e-3) / 10e-3;
    out.finds("100 mV below the supply it is what it is at 350 mV, within a tenth, and 25 mV below it is not",
              std::abs(rest(leak, 100e-3) - 100) < 10 && std::abs(rest(leak, 25e-3) - 100) > 10, source);
    out.claim("it ends as a resistor of", 1 / g, "ohm");
    const double straight = leak.at(0.7 - 5e-3) / 5e-3 / g;
    out.claim("... whose conductance 5 and 10 mV below the supply differs by", 100 * std::abs(straight - 1), "%")
        .at_most(20, "thesis 4.4: it behaves as a resistor; a fifth is set here");
    out.plot("What is left of the leak as the membrane nears the supply", "u (V)", "pA")
        .shape("constant, then as a resistor's")
        .add("I_LEAK 2 pA", leak.times(1, 1e12));
    return {};
}

/// The trigger with its bulks led out; lifted: what N bulks are above VSS and P bulks below VDD, each pair of devices by itself.
constexpr auto lifted = R"(The trigger's window under forward body bias
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

Result<void> tell_body_bias(const Hysteresis& t, Outcome& out) {
    Plot& plot = out.plot("The window under forward body bias", "bulks lifted by (V)", "threshold (V)");
    for (const auto& [name, knob] : {std::pair{"all six", "all"}, {"those in feedback", "feedback"}}) {
        Line high, low;
        for (const double by : {0.0, 0.1, 0.2, 0.3, 0.37}) {
            const auto found = found_in({lifted, {fmt::format("{}={}", knob, by)}});
            if (!found) return found.error();
            const auto h = hysteresis_in(*found, "v(out)");
            high.x.push_back(by), high.y.push_back(h.V_H), low.x.push_back(by), low.y.push_back(h.V_L);
        }
        const double window = 100 * ((high.y.back() - low.y.back()) / (t.V_H - t.V_L) - 1);
        out.claim(fmt::format("bulks of {} lifted by 370 mV, as the transconductors' are: the window changes by", name), window, "%");
        out.claim("... V_H by", high.y.back() - t.V_H, "V"), out.claim("... V_L by", low.y.back() - t.V_L, "V");
        if (name == std::string_view("those in feedback"))
            out.finds("the window's size can be controlled by forward body bias: by a tenth at the least", std::abs(window) > 10, source);
        plot.add(fmt::format("V_H, {}", name), high).add(fmt::format("V_L, {}", name), low);
    }
    return {};
}

Result<Outcome> work(const StudyOptions& options) {
    Outcome out;
    const auto t = trigger_alone();
    if (!t) return t.error();
    if (auto ok = tell_delay(*t, out); !ok) return ok.error();
    if (auto ok = options.at(0.5); !ok) return ok.error();
    if (auto ok = tell_leak(out); !ok) return ok.error();
    if (auto ok = tell_body_bias(*t, out); !ok) return ok.error();
    return out;
}

const Study study{
    "cco", "The oscillator's delay, leak and window",
    "Thresholds beyond the window by a switching delay; a leak that becomes a resistor near the supply; a window that body bias "
    "controls. Thesis 4.4",
    work};

}  // namespace corpuscle::studies::cco
