// Errata of the thesis's appendix E (numbers I1 to I18) that a computation can show and that no study of its figures and equations covers:
// I5's numbers, I6, I9, I13, I14, I16, I18.

#include <fmt/format.h>
#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/bias/bias_sweep.hpp"
#include "reproduction/thesis/inverters.hpp"

namespace corpuscle::studies::errata_inverters {

constexpr double pi = 3.141592653589793;

/// I5: V_Q0, the rest voltage with the bulks at the output, for V_TN = 480 mV, V_TP = -450 mV, I_SP = 2 I_SN and n = 1.27 at 0.7 V.
Result<void> add_sign_claims(StudyResult& out) {
    constexpr double V_TN = 0.48, V_TP = 0.45;  // V, magnitudes
    const auto circuit = elaborate_study_netlist({"quiescent"});
    if (!circuit) return circuit.error();
    const auto vto = [&](const char* name) {
        const auto& c = **circuit;
        return c.models[static_cast<std::size_t>(c.elements[static_cast<std::size_t>(c.find_element(name))].model)]
            .values.find("vto")
            ->second;
    };
    const auto found = run_study_netlist(
        {"quiescent",
         {fmt::format("mn2b.delvto={}", V_TN - vto("mn2b")), fmt::format("mp1b.delvto={}", V_TP - vto("mp1b")), "mp1b.mulu0=2"},
         ".op"});
    if (!found) return found.error();
    const double V_Q0 = found->operating_point("v(qb)");
    out.claim("I5: simulated V_Q0 for V_TN 480 mV, V_TP -450 mV, I_SP = 2 I_SN", V_Q0, "V")
        .derived_as(370.775e-3, "eq. 47b with +: errata I5");
    out.claim("I5: V_Q0 minus [V_DD/2 + (V_TP + V_TN)/2n]", V_Q0 - 0.35 - (V_TN - V_TP) / (2 * 1.27), "V")
        .derived_as(352.847e-3 - 0.35 - (V_TN - V_TP) / (2 * 1.27), "eq. 47b as printed, 352.847 mV")
        .explain("the sign is misprinted; moderate inversion at 0.7 V causes the remaining difference from eq. 47b with +");
    return {};
}

/// I18: the bias generator with the sizes of table 4, compared with those of table 16.
Result<void> add_generator_claims(StudyResult& out) {
    const auto by_4 = run_study_netlist({"bias_table4", {}, ".dc vi 0.1 8 0.02"});
    if (!by_4) return by_4.error();
    const auto by_16 = simulate_bias_state({});
    if (!by_16) return by_16.error();
    // bias_table4 has two generators: as printed (6), and with NMOS arrays of 1.5 um (1); vi is I_BIAS, 1 V per uA
    const auto I_Q6 = by_4->curve("dc", "i(vis6)"), V_BN6 = by_4->curve("dc", "v(bn6)"), I_Q1 = by_4->curve("dc", "i(vis1)"),
               V_BN1 = by_4->curve("dc", "v(bn1)");
    constexpr double I_BIAS = 200e-9, min_V_BN = 0.1;  // A; V: fig. 53a's smallest V_BN
    out.claim("I18: table 16's V_BN at 200 nA", by_16->V_BN, "V").allow_range(min_V_BN, 0.6, "E.2, fig. 53a: 100 to 600 mV");
    out.claim("I18: table 16's I_Q at 200 nA", by_16->I_Q, "A").derived_as(I_BIAS, "E.2: I_Q = I_BIAS");
    const char* why =
        "arrays with table 4's aspect ratios carry more than 200 nA at V_REF without any forward bias, so M4A is forced into its linear "
        "region. Table 4 sizes a different circuit from table 16 (errata I18)";
    for (const auto& [name, V_BN, I_Q] :
         {std::tuple{"table 4 as printed", &V_BN6, &I_Q6}, {"table 4 with NMOS arrays of 1.5 um", &V_BN1, &I_Q1}}) {
        auto& voltage =
            out.claim(fmt::format("I18: {}: V_BN at 200 nA", name), V_BN->at(0.2), "V").allow_range(min_V_BN, 0.6, "E.2, fig. 53a");
        if (voltage.needs_explanation()) voltage.explain(why);
        auto& current =
            out.claim(fmt::format("I18: {}: I_Q at 200 nA", name), I_Q->at(0.2), "A").derived_as(I_BIAS, "4.3.1: I_BIASB is 200 nA");
        if (current.needs_explanation()) current.explain(why);
        out.claim(fmt::format("I18: {}: current at which V_BN is 100 mV", name), 1e-6 * V_BN->crossing(min_V_BN), "A");
    }
    auto& plot = out.plot("I18: V_BN of three generators", "I_BIAS (uA)", "V");
    plot.log_x = true;
    const auto sweep = BiasSweep::run(BiasAxis::current);
    if (!sweep) return sweep.error();
    plot.add("table 16", sweep->curve("v(bn)").scaled(1e6, 1))
        .add("table 4 as printed", V_BN6)
        .add("table 4 with NMOS arrays of 1.5 um", V_BN1);
    return {};
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    if (auto ok = add_sign_claims(out); !ok) return ok.error();
    const auto generator = elaborate_study_netlist({"bias"});
    if (!generator) return generator.error();
    out.claim_true("I6: the replica is M5B over M4C", (*generator)->find_element("m5c") < 0 && (*generator)->find_element("m4c") >= 0,
                   "errata I6; the text names M4A and M5C, which table 16 does not list");
    const auto state = simulate_bias_state({});
    if (!state) return state.error();
    out.claim("I9: simulated V_Q; table 17's 350.1 read as mV", state->V_Q, "V")
        .published_as(350.1e-3, "errata I9; the table's head says I_D in nA");
    auto& current = out.claim("I9: simulated I_Q; table 17's 350.1 read as nA", state->I_Q, "A").published_as(350.1e-9, "table 17's head");
    if (current.needs_explanation()) current.explain("the head is table 18's: errata I9");
    const auto inverters = InverterSweep::run(10e-3);
    if (!inverters) return inverters.error();
    const double G_B = inverters->transconductance_at_zero('b'), G_C = inverters->transconductance_at_zero('c'), C = G_B / (2 * pi * 2);
    out.claim("I13: capacitor of a 2 Hz filter with INVB", C, "F").derived_as(0.2e-6, "errata I13: from 2.5 uS");
    out.claim("I13: this capacitor over one microfarad", C / 1e-6)
        .allow_max(1, "E.4: \"micro Farad\" capacitors would be needed; by errata I13 a fifth of a microfarad is enough");
    out.claim_true("I14: INVC, not INVB, has the very small transconductance", G_C < 1e-3 * G_B, "errata I14");
    const auto fine_sweep = InverterSweep::run_with_directives(".dc vin 0.345 0.355 20u");
    if (!fine_sweep) return fine_sweep.error();
    auto output_minus_input = fine_sweep->transfer_curve('c');
    for (std::size_t k = 0; k < output_minus_input.x.size(); ++k) output_minus_input.y[k] -= output_minus_input.x[k];
    const double V_Q = output_minus_input.crossing(0);
    auto& offset_claim = out.claim("I16: INVC's V_Q relative to half the supply, as in fig. 57", V_Q, "V")
                             .derived_as(-3e-3, "347 mV of fig. 61 minus 350 mV");
    if (offset_claim.needs_explanation()) offset_claim.explain("the simulated curve is displaced by less and upwards: fig61");
    if (auto ok = add_generator_claims(out); !ok) return ok.error();
    out.note(
        "The other errata are in these studies. I1, I2, I4, I5: eq45-47. I3, I11, I16: fig57. I7, I8: fig54 and fig55. I10: table17-18. "
        "I12: table16. I15: fig61. I17 (which devices have a higher threshold) cannot be checked, because the process card's thresholds "
        "are 150 mV higher by choice.");
    return options.report_progress(0.9) ? Result<StudyResult>(out) : options.report_progress(0.9).error();
}

const Study study{"errata-inverters", "Errata of the inverters", "Errata I1 to I18 of appendix E that a computation can show", compute};

}  // namespace corpuscle::studies::errata_inverters
