// Errata of the thesis's sections 4.3 and 4.4 (numbers S1 to S20) that a computation can show: the printed and the intended form, both
// computed. S1, S2, S5, S7b and S10 are in the study eq16-20, S4 in fig30, S18 in fig40.

#include <fmt/format.h>
#include <cmath>

#include "measure/train_distance.hpp"
#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/active_load.hpp"
#include "reproduction/thesis/chip_vs_model.hpp"
#include "reproduction/thesis/isolated_oscillator.hpp"

namespace corpuscle::studies::errata_signal {

constexpr auto M6 = "M6 8x2 to 2x4 is 1/8 where M5 is 1/64: the N side of the push-pull output is eight times too strong (errata S7)";

/// S7, S8: INVC with the printed and the corrected sizes of its mirror M6.
Result<void> report_M6(StudyResult& out) {
    const auto corrected = run_study_netlist({"invc", {}, ".dc vin 0 0.7 0.5m"});
    const auto as_printed = run_study_netlist({"invc", {"xl.mn6a=8x2", "xl.mn6b=2x4", "xh.mn6a=8x2", "xh.mn6b=2x4"}, ".dc vin 0 0.7 0.5m"});
    if (!corrected) return corrected.error();
    if (!as_printed) return as_printed.error();
    const auto corrected_load = analyse_load(corrected->curve("dc", "i(vl)")),
               printed_load = analyse_load(as_printed->curve("dc", "i(vl)"));
    out.claim("S7: rest voltage of the filter's output, M6 corrected", corrected_load.zero_current_voltage, "V")
        .published_as(350e-3, "thesis 4.3.1, fig. 30a");
    out.claim("S7: rest voltage of the filter's output, M6 as printed", printed_load.zero_current_voltage, "V")
        .published_as(350e-3, "thesis 4.3.1, fig. 30a")
        .explain(M6);
    const auto current = printed_load.current.between(0.1, 0.6);
    out.claim("S7: current at 350 mV with M6 as printed, over that at 450 mV with M6 corrected",
              printed_load.current.at(0.35) / corrected_load.current.at(0.45), "times")
        .allow_range(-0.1, 0.1, "thesis 4.3.1: zero at half the supply; a tenth is our choice")
        .explain(M6);
    out.claim("S7: resistance at 350 mV, M6 corrected", corrected_load.resistance.at(0.35), "ohm")
        .published_as(6.6e9, "thesis 4.3.1")
        .explain("the reasons are those of the study fig30");
    out.claim("S7: resistance at 350 mV, M6 as printed", printed_load.resistance.at(0.35), "ohm")
        .published_as(6.6e9, "thesis 4.3.1")
        .explain(M6);
    const double G = std::abs(corrected->curve("dc", "i(vhalf)").slope_at(0.35));
    out.claim("S8: G_m with the output held times the load's resistance, both at 350 mV", G * corrected_load.resistance.at(0.35), "times")
        .derived_as(146e-12 * 6.6e9, "thesis 4.3.1 (6.6 Gohm) and E.4 (146 pS)");
    out.plot("INVC as a load, with M6 as printed and corrected (S7)", "V_IN (mV)", "current (pA)")
        .describe_published("zero at half the supply")
        .add("corrected, 16x1 to 2x8", corrected_load.current.between(0.1, 0.6).scaled(1e3, 1e12))
        .add("as printed, 8x2 to 2x4", current.scaled(1e3, 1e12));
    return {};
}

/// S9a, S10a: the relative weights of SA-I's three components: the ratios of K_B, K_C and k_A.
Result<void> report_weights(StudyResult& out) {
    const auto sources = run_study_netlist({"rectifier_sa", {}, ".dc vhp 0.37 0.39 1m"}),
               summer = run_study_netlist({"summer", {}, ".dc iin 0.1u 2.6u 0.1u"});
    const auto invc = run_study_netlist({"invc", {}, ".dc vin 0.34 0.36 0.5m"});
    for (const auto* found : {&sources, &summer, &invc})
        if (!*found) return found->error();
    const auto gain = [&](const char* curve) {
        return sources->curve("dc", curve).slope_at(0.38) / sources->curve("dc", "i(vn)").slope_at(0.38);
    };
    const double B = gain("i(vb)"), C = gain("i(vc)"), C_corrected = gain("i(vc2)");  // gains of I_B and I_C
    out.claim("S9a: K_B / K_C by table 6", B / C, "times")
        .derived_as(4, "thesis 3.3: 8 and 2")
        .explain("table 6 gives M2 of I_C the sizes for a gain of 1 (errata S9a)");
    out.claim("S9a: K_B / K_C with M2 of I_C 4x8, as intended here", B / C_corrected, "times").derived_as(4, "thesis 3.3: 8 and 2");
    // k_A relative to the gains above, which relate to the filter's current I_N. INVB turns I_F/2 into V_F, and INVC turns V_F into I_N, so
    // I_N is I_F/2 over INVC's division ratio.
    const double division_ratio = invc->curve("dc", "i(vb)").slope_at(0.35) / invc->curve("dc", "i(vhalf)").slope_at(0.35);
    const auto k_A = [&](const char* curve) { return summer->curve("dc", curve).at(1.2e-6) / 1.2e-6 * division_ratio; };
    out.claim("S10a: K_B / k_A by tables 6 and 7", B / k_A("i(va)"), "times")
        .derived_as(8, "thesis 3.3: 8 uA/N and 1 uA/N")
        .explain("one of the summer's divisions, M2 (1/64) or M3 (1/8), is superfluous (errata S10a)");
    auto& corrected = out.claim("S10a: K_B / k_A with M3B 12x4, as intended here", B / k_A("i(va2)"), "times")
                          .derived_as(8, "thesis 3.3: 8 uA/N and 1 uA/N");
    if (corrected.needs_explanation())
        corrected.explain("M3B was chosen six times as wide, so that the chip fires on the plateau as the model does");
    return {};
}

/// S16: the membrane is charged by I_CHARGE + I_LEAK - I, not by I_CHARGE - I. A large leak shows the difference.
Result<void> report_charging(StudyResult& out) {
    constexpr double I = 300e-12, large_leak = 200e-12;
    double speed[2];  // V/s, charging rate at 0.35 V
    for (const auto& [k, leak] : {std::pair{0, IsolatedOscillator::I_LEAK}, {1, large_leak}}) {
        const auto found = simulate_oscillator({.current = I, .stop_time = 30e-3, .has_high_threshold_switches = true, .leak = leak});
        if (!found) return found.error();
        const auto u = found->curve("tran", "v(u)");
        speed[k] = u.slope_at(u.crossing(0.35, found->number("first_spike")));
    }
    const double charge = IsolatedOscillator::I_CHARGE;
    const double by_errata = (charge + large_leak - I) / (charge + IsolatedOscillator::I_LEAK - I);
    out.claim("S16: at 300 pA, charging rate with I_LEAK 200 pA over that with 2 pA", speed[1] / speed[0], "times")
        .derived_as(by_errata, "errata S16: I_CHARGE + I_LEAK - I");
    out.claim("S16: at 300 pA, charging rate with I_LEAK 200 pA over that with 2 pA, against the printed I_CHARGE - I", speed[1] / speed[0],
              "times")
        .derived_as(1, "thesis 4.4: I_CHARGE - I")
        .explain("the leak, too, pulls the membrane to the supply");
    return {};
}

/// Claims on the spike counts of a chip, phase by phase, beside its model's. `why` explains deviations.
void report_chip(const std::string& name, const std::vector<double>& chip, const std::vector<double>& model, const std::string& why,
                 StudyResult& out) {
    const std::string source = "the model's, computed here; thesis 4.4: similar";
    for (const auto& [phase, window] :
         {std::pair{"rising", press::protraction}, {"holding", press::plateau}, {"falling", press::retraction}, {"after", press::after}}) {
        auto& c = out.claim(fmt::format("{}: spikes, {}", name, phase), press::spike_count(chip, window))
                      .derived_as(press::spike_count(model, window), source);
        if (c.needs_explanation()) c.explain(why);
    }
}

Result<void> report_chips(const StudyOptions& options, StudyResult& out) {
    const auto sa1 = simulate_train({"sa1"}), fa1 = simulate_train({"fa1"});
    if (!sa1) return sa1.error();
    if (!fa1) return fa1.error();
    // as_printed: all sizes of the tables; printed_M6: the intended circuit with only M6 of both filters as printed
    const auto& M6_everywhere = {"hpb.res.mn6a=8x2", "hpb.res.mn6b=2x4", "hpc.res.mn6a=8x2", "hpc.res.mn6b=2x4"};
    TrialSpec printed_M6{.afferent = "sa1-circuit", .probes = {"v(hpb)", "v(hpc)"}};
    for (const char* setting : M6_everywhere) printed_M6.settings.push_back(fmt::format("sa1-circuit.{}", setting));
    const auto as_intended = simulate_train({"sa1-circuit"}),
               as_printed = simulate_train({"sa1-circuit", "press", {"sa1-circuit.as_printed=1"}});
    const auto fa_printed = simulate_train({"fa1-circuit", "press", {"fa1-circuit.as_printed=1"}});
    const auto with_M6 = run_trial(printed_M6);
    for (const auto* train : {&as_intended, &as_printed, &fa_printed})
        if (!*train) return train->error();
    if (!with_M6) return with_M6.error();
    if (auto ok = options.report_progress(0.9); !ok) return ok;
    report_chip("SA-I, tables' sizes, leak of 5 pA, membrane of 1.8 pF", *as_printed, *sa1,
                "I_A is hardly more than the leak of 5 pA plus the leakage of the switches, so it does not sustain firing on the plateau; "
                "I_C has half of the intended gain (errata S9a, S10a)",
                out);
    report_chip("SA-I as intended", *as_intended, *sa1, "the reasons are those of the study fig40", out);
    report_chip("FA-I, table 8's sizes, leak of 5 pA, membrane of 5.4 pF", *fa_printed, *fa1,
                "the ratio of its gains is 8 to 3, the model's is 3.5 to 2.75 (errata S15); its membrane and leak are smaller than these "
                "gains require",
                out);
    report_chip("SA-I as intended, except M6 as printed", with_M6->spikes, *sa1, M6, out);
    out.claim("SA-I as intended, except M6 as printed: rest voltage of filter C's output", with_M6->probes.at("v(hpc)").at(0.2), "V")
        .published_as(350e-3, "thesis 4.3.1")
        .explain(M6);
    const auto distance = [&](const std::vector<double>& model) { return std::sqrt(van_rossum_squared(*as_intended, model, 20e-3)); };
    out.claim_true("S17: SA-I's chip is closer to the model of fig. 17c than to that of 18c (van Rossum, 20 ms)",
                   distance(*sa1) < distance(*fa1), "errata S17; thesis 4.4 says 18c");
    out.plot("The chips as printed and as intended, under the press stimulus", "time (s)", "")
        .raster_row("model sa1", *sa1)
        .raster_row("SA-I as intended", *as_intended)
        .raster_row("SA-I as printed", *as_printed)
        .raster_row("SA-I, M6 as printed", with_M6->spikes)
        .raster_row("model fa1", *fa1)
        .raster_row("FA-I as printed", *fa_printed);
    return {};
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    for (const auto add_part : {report_M6, report_weights, report_charging})
        if (auto ok = add_part(out); !ok) return ok.error();
    if (auto ok = report_chips(options, out); !ok) return ok.error();
    out.note("S3, S6, S11 to S14, S16a, S19 and S20 concern names and units only; there is nothing to compute.");
    return out;
}

const Study study{"errata-signal", "Misprints of the signal processing and the oscillator, computed in both forms",
                  "How do the circuits behave as printed and as corrected? Errata S1 to S20 of thesis 4.3, 4.4", compute};

}  // namespace corpuscle::studies::errata_signal
