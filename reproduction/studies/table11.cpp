// Table 11: currents and small signals of the rectangular arrays, and the sums that reveal its misprints.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/arrays.hpp"

namespace corpuscle::studies::table11 {

Result<StudyResult> compute(const StudyOptions&) {
    const auto found = TRY(simulate_arrays(rectangles));
    const auto& ours = found;
    StudyResult out;
    add_small_signals(out, rectangles, ours);

    const std::string source = "thesis B.1";
    const auto I = [&](const char* name) { return ours(name).I_D; };
    out.claim("B2's current over C2's", I("B2") / I("C2")).published_as(0.25, source);
    out.claim("D2's current over C2's", I("D2") / I("C2")).published_as(4, source);
    out.claim("A's current over C2's", I("A") / I("C2"))
        .derived_as(find_published(rectangles, "A").I_D / find_published(rectangles, "C2").I_D, "table 11");
    out.claim_true("A carries more current than C2, which has the same S_eq", I("A") > I("C2"), source);
    const double V_T = ours("A").V_T;  // shifts below are relative to it
    out.claim_true("A, B2, C2 and D2 have the same threshold", ours("B2").V_T == V_T && ours("C2").V_T == V_T && ours("D2").V_T == V_T,
                   source);
    out.claims.back().of_kind(ClaimKind::identity);
    const auto shift = [&](const char* name) { return ours(name).V_T - V_T; };
    const auto printed_shift = [&](const char* name) {
        return 1e-3 * (find_published(rectangles, name).V_T - find_published(rectangles, "A").V_T);
    };
    for (const char* name : {"B1", "C1", "D1"})
        out.claim(fmt::format("{}: threshold minus A's", name), shift(name), "V")
            .explain(fmt::format("table 11: {:+.1f} mV, by another definition of the threshold. Ours is set so that the array carries the "
                                 "published current with the specific current of the short unit transistor",
                                 1e3 * printed_shift(name)));
    out.next_kind = ClaimKind::arithmetic;
    out.claim_true(
        "as published, V_T rises as L falls and as W grows: this is not drain-induced barrier lowering, because the drain is at 0 V",
        find_published(rectangles, "A").V_T > find_published(rectangles, "B1").V_T &&
            find_published(rectangles, "D1").V_T > find_published(rectangles, "C1").V_T &&
            find_published(rectangles, "C1").V_T > find_published(rectangles, "B1").V_T &&
            find_published(rectangles, "D1").V_T > find_published(rectangles, "A").V_T,
        "errata U13, against \"due to DIBL\" (B.1, C.1)");

    add_sum_rule(out, rectangles, 1e-9, "errata U7: g_md in uS, not nS");
    const auto& d2 = find_published(rectangles, "D2");
    out.claim("D2: g_ms from the printed g_mg + g_md + g_mb", 1e-6 * (d2.g_mg + d2.g_md + d2.g_mb), "S")
        .published_as(1e-6 * d2.g_ms, "table 11; errata U10: 165.1 is meant");
    out.claim("D2: g_ms from four times A's printed g_ms", 4e-6 * find_published(rectangles, "A").g_ms, "S")
        .published_as(1e-6 * d2.g_ms, "table 11; errata U10: 165.1 is meant");
    out.next_kind = ClaimKind::identity;
    double worst = 0;
    for (const auto& a : ours) worst = std::max(worst, std::abs((a.g_mg + a.g_md + a.g_mb) / a.g_ms - 1));
    out.claim("simulated: largest difference of g_mg + g_md + g_mb from g_ms", 100 * worst, "%")
        .allow_max(1e-4, "eq. 27, to the accuracy of the solution");
    return out;
}

const Study study{"table11", "Currents and small signals of the rectangular arrays",
                  "Seven arrays at V_G = V_D = 0.5 V; the sums of their slopes reveal two misprints. Thesis B.1, table 11",
                  ClaimKind::fitted, compute};

}  // namespace corpuscle::studies::table11
