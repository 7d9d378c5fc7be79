// Fig. 53: the bias generator over I_BIAS. M3B and M4A are the transistors at its node BN.
// Symbols. V_BN and V_BP are the body voltages that the generator sets, V_REF is half the supply, V_Q and I_Q are voltage and current of
// the replica, an inverter with its output tied to its input.

#include "reproduction/claims/check_all.hpp"
#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/bias/bias_figure.hpp"

namespace corpuscle::studies::fig53 {

constexpr BiasFigure figure{BiasAxis::current, "53", "I_BIAS (nA)", "A", 1e9, {100e-9, 2e-6}, {100e-9, 700e-9}};

/// True if both transistors at node BN are saturated.
Result<bool> is_saturated(double I_BIAS) {
    const auto s = TRY(simulate_bias_state({bias_setting(BiasAxis::current, I_BIAS)}));
    return s.V_M3B >= s.V_sat_M3B && s.V_M4A >= s.V_sat_M4A;
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    const auto corners = TRY(simulate_bias_figure(figure, out, options));
    const auto& typical = corners.front();
    const auto V_BN = typical.sweep.curve("v(bn)");
    const std::string why =
        "V_BN follows from V_T, n and I_SQ of the process card. Its V_T is set so that the unbiased inverter carries the published 17.5 "
        "nA; the study bias-valid shows the effect of thresholds some tens of millivolts lower";
    for (const auto& [I, printed] : {std::pair{100e-9, 100e-3}, {2e-6, 600e-3}}) {
        auto& c = out.claim(I < 1e-6 ? "typical: V_BN at 100 nA" : "typical: V_BN at 2 uA", V_BN.at(I), "V")
                      .published_as(printed, figure.source());
        if (c.needs_explanation()) c.explain(why);
    }
    out.claim_true("V_BN rises with I_BIAS", V_BN.slope().between(20e-9, 2e-6).min() > 0, figure.source());
    const auto inside = is_saturated(200e-9),  // inside, below and above the working range
        below = is_saturated(0.5 * typical.working_range.from), above = is_saturated(2 * typical.working_range.to);
    TRY(check_all(inside, below, above));
    const char* source = "E.2: saturated in the range, in the linear region below and above it";
    out.claim_true("M3B and M4A are saturated at 200 nA", *inside, source);
    out.claim_true("at least one of them is not saturated at half the lower end of the working range", !*below, source);
    out.claim_true("at least one of them is not saturated at twice the upper end of the working range", !*above, source);
    out.plots[0].describe_published("V_BN from 100 to 600 mV over 100 nA to 2 uA");
    out.plots[1].describe_published("three corners, each with its own range; 100 to 700 nA is common to all");
    return out;
}

const Study study{
    "fig53", "The bias generator over its current",
    "It works from 100 nA to 2 uA typically with V_BN from 100 to 600 mV, and from 100 to 700 nA in all corners. Thesis E.2, fig. 53",
    ClaimKind::predicted, compute};

}  // namespace corpuscle::studies::fig53
