// The oscillator alone, fig. 39: its membrane and spikes under a constant current, its trigger's curve; and its frequency along the
// current.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "study/deck.hpp"
#include "study/studies.hpp"

namespace corpuscle::studies::fig39 {

constexpr auto source = "thesis 4.4, fig. 39";
constexpr double I_LEAK = 2e-12, I_CHARGE = 1e-9, C = 1.8e-12, I_shown = 20e-12;  // A, F; the current of fig. 39a is not printed

/// The cell with its printed currents and capacitor; plain has the switches that table 9 has, the other those of the higher threshold.
constexpr auto netlist = R"(The oscillator under a constant current
.lib '../process/tsmc180.lib' tt
.include 'parts/trigger.inc'
.include 'parts/oscillator.inc'
.param i_in=20p hv=0 until=0.6
vdd vdd 0 0.7
x u s gl gc vdd oscillator c_u=1.8p hv_switch={hv}
ilk gl 0 2p
ich gc 0 1n
iin u 0 pwl(0 0 10m 0 10.1m {i_in})
.options spikecheck=0
.op
.tran 10u {until} 0 5m
.spike v(s) 0.35
)";

Result<Found> driven(double current, double until, bool hv) {
    return found_in({netlist, {fmt::format("i_in={}", current), fmt::format("until={}", until), fmt::format("hv={}", hv ? 0.15 : 0.0)}});
}

struct Trigger {
    Line up, down;
    double V_H, V_L;
};
Result<Trigger> trigger() {
    const auto found = found_in({"schmitt", {}, ".dc vin 0 0.7 1m updown"});
    if (!found) return found.error();
    const auto all = found->line("dc", "v(out)");
    const auto turn = std::max_element(all.x.begin(), all.x.end()) - all.x.begin();
    Trigger out{{{all.x.begin(), all.x.begin() + turn + 1}, {all.y.begin(), all.y.begin() + turn + 1}},
                {{all.x.rbegin(), all.x.rend() - turn}, {all.y.rbegin(), all.y.rend() - turn}},
                0,
                0};
    out.V_H = out.up.where(0.35), out.V_L = out.down.where(0.35);
    return out;
}

void tell_swing(const Found& found, const Trigger& t, Outcome& out) {
    const auto u = found.line("tran", "v(u)"), s = found.line("tran", "v(s)");
    const double first = found.number("first_spike"), low = u.least(), high = u.between(first + 5e-3, u.x.back()).most();
    out.claim("it rests at", found.at_rest("v(u)"), "V").printed_as(0.7, "thesis 4.4: u_rest is the supply");
    out.claim("the membrane falls to", low, "V"), out.claim("V_L of the trigger", t.V_L, "V");
    out.claim("... and is filled to", high, "V"), out.claim("V_H of the trigger", t.V_H, "V");
    out.finds("the swing is that of the hysteresis window, but not exactly: it goes beyond, at one end at least",
              high > t.V_H + 1e-3 && high < t.V_H + 0.1 * (t.V_H - t.V_L) && std::abs(low - t.V_L) < 0.1 * (t.V_H - t.V_L),
              "thesis 4.4: not exactly defined by the window, since there is a switching delay");
    const double middle = (t.V_L + t.V_H) / 2, falls = u.where(middle, first + 5e-3);
    const auto rise = s.between(first, first + 5e-3);
    const double filled = u.between(first, first + 5e-3).where(middle, first);
    out.claim("it is emptied by, at its middle", u.slope_at(falls), "V/s");
    out.claim("... and filled by", u.slope_at(filled), "V/s");
    out.claim("a spike lasts", rise.where(0.35, first + 1e-4) - first, "s");
}

/// f over I, where the membrane is emptied by I - I_leak and filled by I_CHARGE + I_leak - I, from V_H to V_L and back.
double law(double I, double leak, double c, double swing) { return 1 / (c * swing / (I - leak) + c * swing / (I_CHARGE + leak - I)); }

Result<void> tell_frequency(const Trigger& t, const StudyOptions& options, Outcome& out) {
    Line plain, better, by_law;
    double farthest = 0;
    const double swing = t.V_H - t.V_L;
    for (const double I : {4e-12, 8e-12, 20e-12, 60e-12, 200e-12, 500e-12, 800e-12}) {
        const double until = 30e-3 + 6 * 2.5e-12 * swing / (I - I_LEAK) + 2.5e-12 * 0.25 / (I - I_LEAK);
        const auto as_printed = driven(I, until, false), hv = driven(I, until, true);
        if (!as_printed) return as_printed.error();
        if (!hv) return hv.error();
        const auto add = [&](Line& line, double f) { line.x.push_back(1e12 * I), line.y.push_back(f); };
        if (const double T = as_printed->number("mean_interval"); T > 0) add(plain, 1 / T);
        add(better, 1 / hv->number("mean_interval")), add(by_law, law(I, I_LEAK, C, swing));
        farthest = std::max(farthest, std::abs(better.y.back() / by_law.y.back() - 1));
        if (auto ok = options.at(0.5); !ok) return ok;
    }
    out.claim("frequency beside the law of (6) with C alone, better switches: farthest off, 4 to 800 pA", 100 * farthest, "%")
        .at_most(10, "thesis 4.4: it implements the sub-model B, (6); a tenth is set here")
        .because("the gates of the trigger stand beside C: see cco");
    out.plot("Frequency along the current", "I (pA)", "frequency (Hz)")
        .shape("not printed as a curve; by (6) it rises as I - I_LEAK")
        .points("switches as printed", plain)
        .points("switches of the higher threshold", better)
        .add("1 / (C swing / (I - I_LEAK) + C swing / (I_CHARGE + I_LEAK - I))", by_law);
    auto& p = out.plots.back();
    p.log_x = p.log_y = true;
    return {};
}

Result<Outcome> work(const StudyOptions& options) {
    Outcome out;
    const auto t = trigger();
    if (!t) return t.error();
    const auto shown = driven(I_shown, 0.2, false), less = driven(I_LEAK / 2, 0.3, false);
    if (!shown) return shown.error();
    if (!less) return less.error();
    tell_swing(*shown, *t, out);
    const auto u = shown->line("tran", "v(u)");
    out.claim("with half of I_LEAK it stays at", less->line("tran", "v(u)").least(), "V").printed_as(0.7, "thesis 4.4: I < I_LEAK");
    out.claim("... spikes", less->number("spikes")).between(0, 0, source);
    out.claim("V_H - V_L", t->V_H - t->V_L, "V");
    out.plot("39a, membrane and spikes at 20 pA", "time (s)", "V")
        .shape("u falls from the supply to theta, is filled fast to u_rst; s is high meanwhile")
        .add("u", u)
        .add("s", shown->line("tran", "v(s)"));
    out.plot("39b, the trigger's curve", "V_IN (V)", "V_OUT (V)")
        .shape("a hysteresis window between theta and u_rst")
        .add("rising", t->up)
        .add("falling", t->down);
    if (auto ok = tell_frequency(*t, options, out); !ok) return ok.error();
    out.note(
        "I_LEAK 2 pA, I_CHARGE 1 nA and 1.8 pF as printed; the current of fig. 39a is not printed, 20 pA are a choice. 39b is the "
        "trigger's "
        "curve; frequency along the current is beside the thesis.");
    return out;
}

const Study study{"fig39", "The oscillator alone", "Membrane, spikes and the trigger's hysteresis window. Thesis 4.4, fig. 39", work};

}  // namespace corpuscle::studies::fig39
