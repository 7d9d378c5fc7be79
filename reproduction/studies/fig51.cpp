// Fig. 51: inverters with output tied to input. V_Q, their voltage with separate bulks, over the body voltages; V_Q0, their voltage with
// the bulks at the output, over process and temperature.

#include <fmt/format.h>
#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/claims/study_netlist.hpp"

namespace corpuscle::studies::fig51 {

constexpr double n = 1.27, V_DD = 0.7;  // slope factor of tables 11 and 12 and of the process card; V

/// V_Q0, and V_Q with the bulks at the rails (V).
struct QuiescentPoint {
    double V_Q0, V_Q;
};
Result<QuiescentPoint> quiescent_point(const std::vector<std::string>& settings) {
    const auto found = run_study_netlist({"quiescent", settings, ".op"});
    if (!found) return found.error();
    return QuiescentPoint{found->operating_point("v(qb)"), found->operating_point("v(qa)")};
}

Result<void> claim_sensitivity(StudyResult& out, const QuiescentPoint& nominal) {
    double largest = 0;  // V, change of V_Q0
    for (const char* corner : {"ss", "ff", "sf", "fs"}) {
        const auto in_corner = quiescent_point({fmt::format("corner={}", corner)});
        if (!in_corner) return in_corner.error();
        largest = std::max(largest, std::abs(in_corner->V_Q0 - nominal.V_Q0));
    }
    const auto hot = quiescent_point({"temp=95"}), cold = quiescent_point({"temp=-55"});
    if (!hot || !cold) return (hot ? cold : hot).error();
    out.claim("largest change of V_Q0 from the typical corner to another", largest, "V")
        .allow_min(5e-3, "E.1: sensitive to process; 5 mV is our choice");
    auto& c = out.claim("change of V_Q0 from -55 to 95 C", std::abs(hot->V_Q0 - cold->V_Q0), "V")
                  .allow_min(5e-3, "E.1: sensitive to temperature variations; 5 mV is our choice");
    if (c.needs_explanation())
        c.explain(
            "the process card has one temperature law (ACM2's) for N and P, so V_TP + V_TN is constant, and one I_S for both arrays, so "
            "the logarithm is small");
    return {};
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    const auto found = run_study_netlist({"quiescent", {}, ".dc vbn 0 0.4 5m"});
    if (!found) return found.error();
    const auto both_biased = found->curve("dc", "v(qa)"), v_bn_only = found->curve("dc", "v(qe)"), V_Q0 = found->curve("dc", "v(qb)"),
               I_Q = found->curve("dc", "i(visa)");
    out.claim("V_Q, bulks at the rails", both_biased.at(0), "V").published_as(355.1e-3, "table 17, mean without biasing, mismatch only");
    out.claim("I_Q, bulks at the rails", I_Q.at(0), "A").published_as(17.59e-9, "table 18, mean without biasing, mismatch only");
    out.claim("V_Q0, bulks at the output", V_Q0.at(0), "V");
    const auto line = v_bn_only.fit_line();
    out.claim("V_Q over V_BN, V_BP fixed: slope", line.slope, "V/V").derived_as(-(n - 1) / 2, "eq. 47a: -(n-1)/2");
    out.claim("V_Q over V_BN, V_BP fixed: largest difference from a straight line, relative to the change of V_Q",
              100 * line.max_deviation / (v_bn_only.max() - v_bn_only.min()), "%")
        .allow_max(5, "E.1: V_Q varies almost proportionally with the bulk voltages; a twentieth is our choice");
    out.claim("change of V_Q when both bulks are biased equally, 0 to 0.35 V", std::abs(both_biased.at(0.35) - both_biased.at(0)), "V")
        .allow_max(5e-3, "eq. 47a: no change, as V_BP + V_BN is constant; 5 mV is our choice");
    out.claim("I_Q with both bulks at half the supply, over that with bulks at the rails", I_Q.at(0.35) / I_Q.at(0), "times");
    const auto nominal = quiescent_point({});
    if (!nominal) return nominal.error();
    if (auto ok = claim_sensitivity(out, *nominal); !ok) return ok.error();
    StudyCurve by_47a;  // a straight line, so two points are enough
    for (const double V_BN : {0.0, 0.4}) {
        const double V_0 = V_Q0.at(0);
        by_47a.x.push_back(V_BN), by_47a.y.push_back(V_0 + (n - 1) * (V_0 - (V_DD + V_BN) / 2));
    }
    out.plot("V_Q over the bulk voltages", "V_BN (V)", "V")
        .add("V_Q (51a), V_BN only", v_bn_only)
        .add("eq. 47a with V_Q0 of 51b", by_47a)
        .add("V_Q (51a), both biased equally", both_biased)
        .add("V_Q0 (51b)", V_Q0)
        .describe_published("the figure shows circuits only: 51a and 51b extract V_Q and V_Q0");
    out.plot("I_Q with both bulks biased equally", "V_BN, V_DD - V_BP (V)", "I_Q (nA)").add("I_Q", I_Q.scaled(1, 1e9)).log_y = true;
    return options.report_progress(0.9) ? Result<StudyResult>(out) : options.report_progress(0.9).error();
}

const Study study{"fig51", "Operating point of an inverter with its output tied to its input",
                  "V_Q varies almost in proportion to the bulk voltages; V_Q0 is sensitive to process and temperature. Thesis E.1, fig. 51",
                  compute};

}  // namespace corpuscle::studies::fig51
