// Fig. 39: the isolated oscillator: its membrane and spikes under a constant current, its trigger's curve, and its frequency over the
// current.
// Symbols. V_H and V_L are the input voltages at which the trigger switches. The input current I discharges the membrane u, I_LEAK opposes
// it, I_CHARGE charges u after a spike. s is the output.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/isolated_oscillator.hpp"

namespace corpuscle::studies::fig39 {

constexpr auto source = "thesis 4.4, fig. 39";
using O = IsolatedOscillator;
constexpr double I_shown = 20e-12;  // A: our choice, the current of fig. 39a is not published

/// Claims on one cycle under I_shown: the swing of the membrane, its rates, and the duration of a spike.
void report_swing(const NetlistResult& found, const Hysteresis& t, StudyResult& out) {
    const auto u = found.curve("tran", "v(u)"), s = found.curve("tran", "v(s)");
    const double first = found.number("first_spike"), low = u.min(), high = u.between(first + 5e-3, u.x.back()).max();
    out.claim("rest voltage of the membrane", found.operating_point("v(u)"), "V").derived_as(0.7, "thesis 4.4: u_rest is the supply");
    out.claim("the membrane falls to", low, "V"), out.claim("V_L of the trigger", t.V_L, "V");
    out.claim("the membrane is charged to", high, "V"), out.claim("V_H of the trigger", t.V_H, "V");
    out.claim_true("the swing equals the hysteresis window only approximately: at least at its upper end it is larger",
                   high > t.V_H + 1e-3 && high < t.V_H + 0.1 * (t.V_H - t.V_L) && std::abs(low - t.V_L) < 0.1 * (t.V_H - t.V_L),
                   "thesis 4.4: the swing is not exactly defined by the window, since there is a switching delay");
    const double middle = (t.V_L + t.V_H) / 2, fall_time = u.crossing(middle, first + 5e-3);
    const auto rise = s.between(first, first + 5e-3);
    const double rise_time = u.between(first, first + 5e-3).crossing(middle, first);
    out.claim("discharge rate at the middle of the swing", u.slope_at(fall_time), "V/s");
    out.claim("charging rate at the middle of the swing", u.slope_at(rise_time), "V/s");
    out.claim("duration of a spike", rise.crossing(0.35, first + 1e-4) - first, "s");
}

/// Membrane capacitance and leak, from the rates (V/s) at which the membrane voltage falls at two currents (A).
struct Membrane {
    double C, leak;  ///< F, A
    Membrane(double I_1, double fall_rate_1, double I_2, double fall_rate_2)
        : C((I_2 - I_1) / (fall_rate_2 - fall_rate_1)), leak(I_1 - C * fall_rate_1) {}
};

/// Frequency (Hz) if the membrane is discharged by I - I_leak and charged by I_CHARGE + I_leak - I, from V_H to V_L and back.
double ideal_frequency(double I, double leak, double C, double swing) {
    return 1 / (C * swing / (I - leak) + C * swing / (O::I_CHARGE + leak - I));
}

constexpr double currents[] = {4e-12, 8e-12, 20e-12, 60e-12, 200e-12, 500e-12, 800e-12};  // A

/// The frequency (Hz), and the rate (V/s, positive) at which the membrane voltage falls at 350 mV, over the current (A). Only currents at
/// which the oscillator fires twice.
struct CurrentSweep {
    StudyCurve frequency, fall_rate;
};
/// `swing` (V) is the trigger's window, from which the simulated time follows.
Result<CurrentSweep> sweep_current(bool high_threshold_switches, double swing) {
    CurrentSweep out;
    for (const double I : currents) {
        // long enough for several spikes: about six discharges of the swing, and the first one from the supply
        const double until = 30e-3 + 2.5e-12 * (6 * swing + 0.25) / (I - O::I_LEAK);
        const auto found = simulate_oscillator({.current = I, .stop_time = until, .has_high_threshold_switches = high_threshold_switches});
        if (!found) return found.error();
        const double T = found->number("mean_interval"), first = found->number("first_spike");
        if (!(T > 0)) continue;
        const auto u = found->curve("tran", "v(u)");
        out.frequency.x.push_back(I), out.frequency.y.push_back(1 / T);
        out.fall_rate.x.push_back(I), out.fall_rate.y.push_back(-u.slope_at(u.crossing(0.35, first + T / 4)));
    }
    return out;
}

Result<void> report_frequency(const Hysteresis& t, const StudyOptions& options, StudyResult& out) {
    const double swing = t.V_H - t.V_L;
    const auto standard = sweep_current(false, swing), high_threshold = sweep_current(true, swing);
    if (!standard) return standard.error();
    if (!high_threshold) return high_threshold.error();
    if (auto ok = options.report_progress(0.9); !ok) return ok;
    // from the rates at 8 and 20 pA
    const Membrane m(currents[1], high_threshold->fall_rate.at(currents[1]), currents[2], high_threshold->fall_rate.at(currents[2]));
    // largest error (%) of ideal_frequency with this leak and capacitance, for currents up to `to` (A)
    const auto worst_error = [&](double leak, double C, double to) {
        double worst = 0;
        for (const double I : currents)
            if (I <= to) worst = std::max(worst, std::abs(high_threshold->frequency.at(I) / ideal_frequency(I, leak, C, swing) - 1));
        return 100 * worst;
    };
    out.claim("membrane capacitance, with the trigger's gates", m.C, "F")
        .published_as(O::C, "thesis 4.4: 1.8 pF of input capacitance")
        .explain("the gates of the trigger are in parallel with the capacitor");
    out.claim("leak of the membrane, with high-threshold switches", m.leak, "A")
        .published_as(O::I_LEAK, source)
        .explain(
            "2 pA is only a little more than the current of M1A at V_GS = 0, so M1A as a diode is not saturated, while M1B is (study cco)");
    out.claim("frequency against (6) with this capacitance and leak, 4 to 60 pA: largest difference", worst_error(m.leak, m.C, 60e-12), "%")
        .allow_max(10, "thesis 4.4: it implements the leaky integrate-and-fire sub-model B, (6); a tenth is our choice");
    auto& fast_range = out.claim("frequency against (6) with this capacitance and leak, 4 to 800 pA: largest difference",
                                 worst_error(m.leak, m.C, 1e-9), "%")
                           .allow_max(10, "thesis 4.4: it implements the leaky integrate-and-fire sub-model B, (6); a tenth is our choice");
    if (fast_range.needs_explanation())
        fast_range.explain("the delay of the trigger increases the swing, more so the faster the membrane falls (study cco)");
    out.claim("frequency against (6) with the published 2 pA and 1.8 pF, 4 to 800 pA: largest difference",
              worst_error(O::I_LEAK, O::C, 1e-9), "%");
    StudyCurve expected;
    for (const double I : currents) expected.x.push_back(I), expected.y.push_back(ideal_frequency(I, O::I_LEAK, O::C, swing));
    auto& p = out.plot("Frequency over the current", "I (pA)", "frequency (Hz)")
                  .points("switches as printed", standard->frequency.scaled(1e12, 1))
                  .points("high-threshold switches", high_threshold->frequency.scaled(1e12, 1))
                  .add("(6) with 2 pA, 1.8 pF and the trigger's window", expected.scaled(1e12, 1));
    p.log_x = p.log_y = true;
    return {};
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    const auto t = simulate_trigger();
    if (!t) return t.error();
    const auto shown_case = simulate_oscillator({.current = I_shown}),
               below_leak = simulate_oscillator({.current = O::I_LEAK / 2, .stop_time = 0.3});
    if (!shown_case) return shown_case.error();
    if (!below_leak) return below_leak.error();
    report_swing(*shown_case, *t, out);
    const auto u = shown_case->curve("tran", "v(u)");
    out.claim("with an input of half of I_LEAK the membrane stays at", below_leak->curve("tran", "v(u)").min(), "V")
        .derived_as(0.7, "thesis 4.4: I < I_LEAK");
    out.claim("with an input of half of I_LEAK: spikes", below_leak->number("spikes")).allow_range(0, 0, source);
    out.claim("hysteresis window V_H - V_L", t->V_H - t->V_L, "V");
    out.plot("39a, membrane and spikes at 20 pA", "time (s)", "V")
        .describe_published("u falls from the supply to theta and is charged fast to u_rst; s is high meanwhile")
        .add("u", u)
        .add("s", shown_case->curve("tran", "v(s)"));
    out.plot("39b, the trigger's curve", "V_IN (V)", "V_OUT (V)")
        .describe_published("a hysteresis window between theta and u_rst")
        .add("rising", t->rising)
        .add("falling", t->falling);
    if (auto ok = report_frequency(*t, options, out); !ok) return ok.error();
    out.note(
        "I_LEAK 2 pA, I_CHARGE 1 nA and 1.8 pF as published; the current of fig. 39a is not published, 20 pA is our choice. 39b is the "
        "trigger's curve. The thesis has no curve of frequency over current.");
    return out;
}

const Study study{"fig39", "The isolated oscillator", "Membrane, spikes and the trigger's hysteresis window. Thesis 4.4, fig. 39", compute};

}  // namespace corpuscle::studies::fig39
