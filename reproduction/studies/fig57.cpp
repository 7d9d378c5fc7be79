// Fig. 57: current and transconductance of INVA and INVB, output held at half the supply. V_IN is relative to half the supply.

#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/bias/bias_sweep.hpp"
#include "reproduction/thesis/inverters.hpp"

namespace corpuscle::studies::fig57 {

/// The largest difference of G between V_IN and -V_IN, over the largest G.
double asymmetry(const StudyCurve& G) {
    double out = 0;
    for (std::size_t k = 0; k < G.x.size(); ++k)
        if (G.x[k] >= 0 && !std::isnan(G.at(-G.x[k]))) out = std::max(out, std::abs(G.y[k] - G.at(-G.x[k])));
    return out / G.max();
}

/// E.3: INVB's source resistors (tails) M1A and M2A are transistors that its diodes hold in the linear region; INVA's transistors are in
/// weak inversion.
Result<void> claim_regions(StudyResult& out) {
    const auto found = run_study_netlist({"invb", {}, ".op"});
    if (!found) return found.error();
    const double tail_N = found->operating_point("v(xh.sn)"), tail_P = 0.7 - found->operating_point("v(xh.sp)");
    const auto state = simulate_bias_state({});
    if (!state) return state.error();
    out.claim("INVB: voltage across M2A, which is held in the linear region", tail_N, "V")
        .allow_max(state->V_sat_M4A, "E.3, fig. 56 (errata I11); such an array at 200 nA is saturated from this voltage on");
    out.claim("INVB: voltage across M1A, which is held in the linear region", tail_P, "V")
        .allow_max(state->V_sat_M3B, "E.3, fig. 56 (errata I11); such an array at 200 nA is saturated from this voltage on");
    // from V_sat = phi_t (sqrt(1 + i_f) + 3)
    const double i_f = std::pow(state->V_sat_M4A / (1.380649e-23 * 300.15 / 1.602176634e-19) - 3, 2) - 1;
    auto& weak =
        out.claim("inversion level i_f of INVA's arrays at 200 nA", i_f).allow_max(1, "E.3: the transistors operate in weak inversion");
    if (weak.needs_explanation()) weak.explain("200 nA in these arrays is moderate inversion by I_SQ of tables 11 to 14");
    return {};
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    const auto inverters = InverterSweep::run(2e-3);
    if (!inverters) return inverters.error();
    const auto I_A = inverters->output_current('a'), I_B = inverters->output_current('b'), G_A = inverters->transconductance('a'),
               G_B = inverters->transconductance('b');
    auto& currents = out.plot("Fig. 57a: current of the output, held at half the supply", "V_IN (mV)", "I_o (uA)");
    currents.add("INVA", I_A.scaled(1e3, 1e6))
        .add("INVB", I_B.scaled(1e3, 1e6))
        .describe_published("INVA's much larger; V_IN from -350 to 350 mV");
    auto& conductances = out.plot("Fig. 57b: transconductance", "V_IN (mV)", "G_m (uS)");
    conductances.add("INVA", G_A.scaled(1e3, 1e6))
        .add("INVB", G_B.scaled(1e3, 1e6))
        .describe_published("INVA's higher, and much more non-linear");
    double smallest_ratio = 1e300;
    for (std::size_t k = 0; k < I_A.x.size(); ++k)
        if (std::abs(I_A.x[k]) > 0.05) smallest_ratio = std::min(smallest_ratio, std::abs(I_A.y[k] / I_B.y[k]));
    out.claim("INVA's current over INVB's, smallest ratio for V_IN beyond 50 mV from 0", smallest_ratio, "times")
        .allow_min(2, "E.3: much larger; a factor of two is our choice");
    out.claim("INVA: transconductance at V_IN = 0", G_A.at(0), "S");
    out.claim("INVB: transconductance at V_IN = 0", G_B.at(0), "S").published_as(2.5e-6, "E.4: about 2.5 uS");
    out.claim("INVA's transconductance over INVB's at V_IN = 0", G_A.at(0) / G_B.at(0), "times")
        .allow_min(1, "E.3: a higher transconductance");
    auto& asymmetry_claim =
        out.claim("INVA: largest difference of G_m between V_IN and -V_IN, over the largest G_m", 100 * asymmetry(G_A), "%")
            .allow_max(10, "E.3: symmetrical; a tenth is our choice");
    if (asymmetry_claim.needs_explanation())
        asymmetry_claim.explain("the largest difference is at the rails, where velocity saturation affects N more than P");
    if (auto ok = claim_regions(out); !ok) return ok.error();
    if (auto ok = options.report_progress(0.9); !ok) return ok.error();
    out.note("Half the supply counts as 0 V in these figures (errata I16). The gate transconductance is meant, not gate-to-drain (I3).");
    return out;
}

const Study study{
    "fig57", "Current and transconductance of INVA and INVB",
    "INVA's current and transconductance are much larger than those of the linearised INVB, about 2.5 uS. Thesis E.3, fig. 57", compute};

}  // namespace corpuscle::studies::fig57
