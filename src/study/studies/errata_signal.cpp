// Errata S1 to S20 that a computation can show: what is printed and what is meant, both computed. (S1, S2, S5, S7b and S10 are in eq16-20,
// S4 in fig30, S18 in fig40.)

#include <fmt/format.h>
#include <cmath>

#include "measure/distance.hpp"
#include "study/studies.hpp"
#include "study/thesis/beside.hpp"
#include "study/thesis/load.hpp"
#include "study/thesis/oscillator_alone.hpp"

namespace corpuscle::studies::errata_signal {

namespace P = press;
constexpr auto M6 = "M6 8x2 to 2x4 is 1/8 where M5 is 1/64: the N side of the push-pull output is eight times too strong (errata S7)";

/// S7, S8: INVC with the printed M6 and as mended.
Result<void> tell_M6(Outcome& out) {
    const auto mended = found_in({"invc", {}, ".dc vin 0 0.7 0.5m"});
    const auto printed = found_in({"invc", {"xl.mn6a=8x2", "xl.mn6b=2x4", "xh.mn6a=8x2", "xh.mn6b=2x4"}, ".dc vin 0 0.7 0.5m"});
    if (!mended) return mended.error();
    if (!printed) return printed.error();
    const auto right = load_of(mended->line("dc", "i(vl)")), wrong = load_of(printed->line("dc", "i(vl)"));
    out.claim("S7: the filter's output rests at, M6 mended", right.rest, "V").printed_as(350e-3, "thesis 4.3.1, fig. 30a");
    out.claim("S7: ... M6 as printed", wrong.rest, "V").printed_as(350e-3, "thesis 4.3.1, fig. 30a").because(M6);
    const auto current = wrong.current.between(0.1, 0.6);
    out.claim("S7: current at 350 mV, M6 as printed, over the mended's at 450 mV", wrong.current.at(0.35) / right.current.at(0.45), "times")
        .between(-0.1, 0.1, "thesis 4.3.1: zero at half the supply; a tenth is set here")
        .because(M6);
    out.claim("S7: resistance at 350 mV, mended", right.resistance.at(0.35), "ohm").printed_as(6.6e9, "thesis 4.3.1").because("see fig30");
    out.claim("S7: ... as printed", wrong.resistance.at(0.35), "ohm").printed_as(6.6e9, "thesis 4.3.1").because(M6);
    const double G = std::abs(mended->line("dc", "i(vhalf)").slope_at(0.35));
    out.claim("S8: G_m with the output held, times the load's resistance, both at 350 mV", G * right.resistance.at(0.35), "times")
        .held_to(146e-12 * 6.6e9, "thesis 4.3.1 (6.6 Gohm) and E.4 (146 pS)");
    out.plot("INVC as a load, with the printed M6 and mended (S7)", "V_IN (mV)", "current (pA)")
        .shape("zero at half the supply")
        .add("mended, 16x1 to 2x8", right.current.between(0.1, 0.6).times(1e3, 1e12))
        .add("as printed, 8x2 to 2x4", current.times(1e3, 1e12));
    return {};
}

/// S9a, S10a: how the three components weigh beside each other.
Result<void> tell_weights(Outcome& out) {
    const auto sources = found_in({"rectifier_sa", {}, ".dc vhp 0.37 0.39 1m"}),
               summer = found_in({"summer", {}, ".dc iin 0.1u 2.6u 0.1u"});
    const auto invc = found_in({"invc", {}, ".dc vin 0.34 0.36 0.5m"});
    for (const auto* found : {&sources, &summer, &invc})
        if (!*found) return found->error();
    const auto gain = [&](const char* curve) {
        return sources->line("dc", curve).slope_at(0.38) / sources->line("dc", "i(vn)").slope_at(0.38);
    };
    const double B = gain("i(vb)"), C = gain("i(vc)"), C_mended = gain("i(vc2)");
    out.claim("S9a: K_B / K_C by table 6", B / C, "times")
        .held_to(4, "thesis 3.3: 8 and 2")
        .because("table 6 sizes M2 of I_C for a gain of 1 (errata S9a)");
    out.claim("S9a: ... M2 of I_C 4x8, as intended here", B / C_mended, "times").held_to(4, "thesis 3.3: 8 and 2");
    // I_F/2 goes through INVB's conductance into V_F, from there into I_N: I_N is I_F/2 over what INVC divides by
    const double divides = invc->line("dc", "i(vb)").slope_at(0.35) / invc->line("dc", "i(vhalf)").slope_at(0.35);
    const auto k_A = [&](const char* curve) { return summer->line("dc", curve).at(1.2e-6) / 1.2e-6 * divides; };
    out.claim("S10a: K_B / k_A by tables 6 and 7", B / k_A("i(va)"), "times")
        .held_to(8, "thesis 3.3: 8 uA/N and 1 uA/N")
        .because("one of the summer's M2 (1/64) and M3 (1/8) is too many (errata S10a)");
    auto& mended =
        out.claim("S10a: ... M3B 12x4, as intended here", B / k_A("i(va2)"), "times").held_to(8, "thesis 3.3: 8 uA/N and 1 uA/N");
    if (mended.needs_reason()) mended.because("M3B was chosen six times as wide, for the plateau to fire as the model's");
    return {};
}

/// S16: the membrane is filled by I_CHARGE + I_LEAK - I, not by I_CHARGE - I; with a leak that is large enough to be seen.
Result<void> tell_charging(Outcome& out) {
    constexpr double I = 300e-12, much = 200e-12;
    double speed[2];
    for (const auto& [k, leak] : {std::pair{0, OscillatorAlone::I_LEAK}, {1, much}}) {
        const auto found = driven({.current = I, .until = 30e-3, .better_switches = true, .leak = leak});
        if (!found) return found.error();
        const auto u = found->line("tran", "v(u)");
        speed[k] = u.slope_at(u.where(0.35, found->number("first_spike")));
    }
    const double charge = OscillatorAlone::I_CHARGE;
    const double by_errata = (charge + much - I) / (charge + OscillatorAlone::I_LEAK - I);
    out.claim("S16: at 300 pA, filled with I_LEAK 200 pA faster than with 2 pA", speed[1] / speed[0], "times")
        .held_to(by_errata, "errata S16: I_CHARGE + I_LEAK - I");
    out.claim("S16: ... by the printed I_CHARGE - I", speed[1] / speed[0], "times")
        .held_to(1, "thesis 4.4: I_CHARGE - I")
        .because("the leak, too, pulls to the supply");
    return {};
}

void tell_chip(const std::string& name, const std::vector<double>& chip, const std::vector<double>& model, const std::string& why,
               Outcome& out) {
    const std::string source = "the model's, made here; thesis 4.4: similar";
    for (const auto& [phase, stretch] : {std::pair{"rising", P::up}, {"holding", P::plateau}, {"falling", P::down}, {"after", P::after}}) {
        auto& c = out.claim(fmt::format("{}: spikes, {}", name, phase), press::count(chip, stretch))
                      .held_to(press::count(model, stretch), source);
        if (c.needs_reason()) c.because(why);
    }
}

Result<void> tell_chips(const StudyOptions& options, Outcome& out) {
    const auto sa1 = train_of({"sa1"}), fa1 = train_of({"fa1"});
    if (!sa1) return sa1.error();
    if (!fa1) return fa1.error();
    const auto& M6_everywhere = {"hpb.res.mn6a=8x2", "hpb.res.mn6b=2x4", "hpc.res.mn6a=8x2", "hpc.res.mn6b=2x4"};
    Asked wrong{.afferent = "sa1-circuit", .traces = {"v(hpb)", "v(hpc)"}};
    for (const char* knob : M6_everywhere) wrong.settings.push_back(fmt::format("sa1-circuit.{}", knob));
    const auto as_mended = train_of({"sa1-circuit"}), as_printed = train_of({"sa1-circuit", "press", {"sa1-circuit.as_printed=1"}});
    const auto fa_printed = train_of({"fa1-circuit", "press", {"fa1-circuit.as_printed=1"}});
    const auto with_M6 = told_of(wrong);
    for (const auto* train : {&as_mended, &as_printed, &fa_printed})
        if (!*train) return train->error();
    if (!with_M6) return with_M6.error();
    if (auto ok = options.at(0.9); !ok) return ok;
    tell_chip(
        "SA-I, tables' sizes, 5 pA, 1.8 pF", *as_printed, *sa1,
        "I_A is hardly more than the leak of 5 pA and what the switches leak, and so does not hold the plateau; I_C's gain is half (errata "
        "S9a, S10a)",
        out);
    tell_chip("SA-I as intended", *as_mended, *sa1, "see fig40", out);
    tell_chip(
        "FA-I, table 8's sizes, 5 pA, 5.4 pF", *fa_printed, *fa1,
        "its gains are 8 to 3 where the model's are 3.5 to 2.75 (errata S15), its membrane and leak smaller than those that go with them",
        out);
    tell_chip("SA-I as intended but for the printed M6", with_M6->spikes, *sa1, M6, out);
    out.claim("SA-I but for the printed M6: filter C's output rests at", with_M6->traces.at("v(hpc)").at(0.2), "V")
        .printed_as(350e-3, "thesis 4.3.1")
        .because(M6);
    const auto apart = [&](const std::vector<double>& model) { return std::sqrt(van_rossum_squared(*as_mended, model, 20e-3)); };
    out.finds("S17: SA-I's chip is nearer to the model of fig. 17c than to that of 18c (van Rossum, 20 ms)", apart(*sa1) < apart(*fa1),
              "errata S17; thesis 4.4 says 18c");
    out.plot("The chips as printed and as intended, under the press", "time (s)", "")
        .row("model sa1", *sa1)
        .row("SA-I as intended", *as_mended)
        .row("SA-I as printed", *as_printed)
        .row("SA-I, M6 as printed", with_M6->spikes)
        .row("model fa1", *fa1)
        .row("FA-I as printed", *fa_printed);
    return {};
}

Result<Outcome> work(const StudyOptions& options) {
    Outcome out;
    for (const auto part : {tell_M6, tell_weights, tell_charging})
        if (auto ok = part(out); !ok) return ok.error();
    if (auto ok = tell_chips(options, out); !ok) return ok.error();
    out.note("Names and units alone are S3, S6, S11 to S14, S16a, S19 and S20: nothing to compute.");
    return out;
}

const Study study{"errata-signal", "Misprints of the signal processing and the oscillator, computed both ways",
                  "What would the circuits do as printed, and what do they as mended? Errata S1 to S20 of thesis 4.3, 4.4", work};

}  // namespace corpuscle::studies::errata_signal
