// The oscillator alone, fig. 39: its membrane and spikes under a constant current, its trigger's curve; and its frequency along the
// current.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "study/studies.hpp"
#include "study/thesis/oscillator_alone.hpp"

namespace corpuscle::studies::fig39 {

constexpr auto source = "thesis 4.4, fig. 39";
using O = OscillatorAlone;
constexpr double I_shown = 20e-12;  // A: the current of fig. 39a is not printed

void tell_swing(const Found& found, const Hysteresis& t, Outcome& out) {
    const auto u = found.line("tran", "v(u)"), s = found.line("tran", "v(s)");
    const double first = found.number("first_spike"), low = u.least(), high = u.between(first + 5e-3, u.x.back()).most();
    out.claim("it rests at", found.at_rest("v(u)"), "V").held_to(0.7, "thesis 4.4: u_rest is the supply");
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

/// What the membrane has and what pulls it up, by how fast it is emptied with two currents.
struct Membrane {
    double C, leak;  ///< F, A
    Membrane(double I_1, double falls_1, double I_2, double falls_2) : C((I_2 - I_1) / (falls_2 - falls_1)), leak(I_1 - C * falls_1) {}
};

/// f over I, where the membrane is emptied by I - I_leak and filled by I_CHARGE + I_leak - I, from V_H to V_L and back.
double law(double I, double leak, double C, double swing) { return 1 / (C * swing / (I - leak) + C * swing / (O::I_CHARGE + leak - I)); }

constexpr double currents[] = {4e-12, 8e-12, 20e-12, 60e-12, 200e-12, 500e-12, 800e-12};  // A

/// Frequency at each of the currents, and how fast the membrane falls through 350 mV; of those that are more than leaks.
struct Driven {
    Line frequency, falls;
};
Result<Driven> along_current(bool better_switches, double swing) {
    Driven out;
    for (const double I : currents) {
        const double until = 30e-3 + 2.5e-12 * (6 * swing + 0.25) / (I - O::I_LEAK);
        const auto found = driven({.current = I, .until = until, .better_switches = better_switches});
        if (!found) return found.error();
        const double T = found->number("mean_interval"), first = found->number("first_spike");
        if (!(T > 0)) continue;
        const auto u = found->line("tran", "v(u)");
        out.frequency.x.push_back(I), out.frequency.y.push_back(1 / T);
        out.falls.x.push_back(I), out.falls.y.push_back(-u.slope_at(u.where(0.35, first + T / 4)));
    }
    return out;
}

Result<void> tell_frequency(const Hysteresis& t, const StudyOptions& options, Outcome& out) {
    const double swing = t.V_H - t.V_L;
    const auto plain = along_current(false, swing), better = along_current(true, swing);
    if (!plain) return plain.error();
    if (!better) return better.error();
    if (auto ok = options.at(0.9); !ok) return ok;
    const Membrane m(currents[1], better->falls.at(currents[1]), currents[2], better->falls.at(currents[2]));
    const auto farthest = [&](double leak, double C, double to) {
        double most = 0;
        for (const double I : currents)
            if (I <= to) most = std::max(most, std::abs(better->frequency.at(I) / law(I, leak, C, swing) - 1));
        return 100 * most;
    };
    out.claim("the membrane has, with the trigger's gates", m.C, "F")
        .printed_as(O::C, "thesis 4.4: 1.8 pF of input capacitance")
        .because("the gates of the trigger stand beside the capacitor");
    out.claim("its leak with switches of the higher threshold", m.leak, "A")
        .printed_as(O::I_LEAK, source)
        .because("2 pA are so little more than M1A lets through with V_GS = 0 that as a diode it is not saturated, while M1B is (see cco)");
    out.claim("frequency beside the law of (6) with these two, 4 to 60 pA: farthest off", farthest(m.leak, m.C, 60e-12), "%")
        .at_most(10, "thesis 4.4: it implements the leaky integrate-and-fire sub-model B, (6); a tenth is set here");
    auto& fast = out.claim("... to 800 pA", farthest(m.leak, m.C, 1e-9), "%").at_most(10, "the same");
    if (fast.needs_reason()) fast.because("the trigger's delay makes the swing larger, the faster the membrane falls the more (see cco)");
    out.claim("beside the law with the printed 2 pA and 1.8 pF, 4 to 800 pA: farthest off", farthest(O::I_LEAK, O::C, 1e-9), "%");
    Line wanted;
    for (const double I : currents) wanted.x.push_back(I), wanted.y.push_back(law(I, O::I_LEAK, O::C, swing));
    auto& p = out.plot("Frequency along the current", "I (pA)", "frequency (Hz)")
                  .points("switches as printed", plain->frequency.times(1e12, 1))
                  .points("switches of the higher threshold", better->frequency.times(1e12, 1))
                  .add("the law with 2 pA, 1.8 pF and the trigger's window", wanted.times(1e12, 1));
    p.log_x = p.log_y = true;
    return {};
}

Result<Outcome> work(const StudyOptions& options) {
    Outcome out;
    const auto t = trigger_alone();
    if (!t) return t.error();
    const auto shown = driven({.current = I_shown}), less = driven({.current = O::I_LEAK / 2, .until = 0.3});
    if (!shown) return shown.error();
    if (!less) return less.error();
    tell_swing(*shown, *t, out);
    const auto u = shown->line("tran", "v(u)");
    out.claim("with half of I_LEAK it stays at", less->line("tran", "v(u)").least(), "V").held_to(0.7, "thesis 4.4: I < I_LEAK");
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
