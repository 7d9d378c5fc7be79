// Fig. 53: the bias generator over I_BIAS. M3B and M4A are the transistors at its node BN.
// Symbols. V_BN and V_BP are the body voltages that the generator sets, V_REF is half the supply, V_Q and I_Q are voltage and current of
// the replica, an inverter with its output tied to its input.

#include <fmt/format.h>

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

/// The range as E.2 describes it, in the typical corner and over all three. The corners' 40 mV were chosen to shrink the range to the
/// published one, so the ends that the corners limit are fitted.
void claim_described_ranges(StudyResult& out, const std::vector<BiasCorner>& corners) {
    const auto typical = corners.front().sweep.described_range();
    auto all = typical;
    for (const auto& c : corners) all = range_intersection(all, c.sweep.described_range());
    const std::string words = ", V_BN 100 to 600 mV with M3B and M4A saturated: ";
    const std::string why =
        "M4A and M3B leave saturation, or V_BN its limits. Arrays 3.4 times as wide would have the published range, but not the published "
        "ranges of supply and temperature (study bias-valid)";
    const auto add = [&](const std::string& label, double value, double published) -> Claim& {
        return out.claim(label, value, figure.unit).published_as(published, figure.source()).explain_if_needed(why);
    };
    add("typical" + words + "from", typical.from, figure.typical_range[0]);
    add("typical" + words + "to", typical.to, figure.typical_range[1]);
    add("all corners" + words + "from", all.from, figure.corner_range[0]).of_kind(ClaimKind::fitted);
    add("all corners" + words + "to", all.to, figure.corner_range[1]).of_kind(ClaimKind::fitted);
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    out.next_kind = ClaimKind::ours;  // by our margins of V_Q and I_Q
    const auto corners = TRY(simulate_bias_figure(figure, out, options));
    for (auto& c : out.claims) c.label += ", by our margins";
    for (auto& c : out.claims)
        if (c.label.starts_with("all corners")) c.of_kind(ClaimKind::fitted);
    out.next_kind = {};
    claim_described_ranges(out, corners);
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
    for (const double V : described_V_BN) out.claim(fmt::format("typical: V_BN is {:g} mV at", 1e3 * V), V_BN.crossing(V), "A");
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
