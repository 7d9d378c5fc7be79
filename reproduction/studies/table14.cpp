// Table 14: currents and small signals of the trapezoidal arrays, the unit of its g_md, and which of F's transistors is at the drain.

#include <fmt/format.h>
#include <cmath>

#include "reproduction/claims/check_all.hpp"
#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/arrays.hpp"

namespace corpuscle::studies::table14 {

/// F in both orientations (errata U17).
Result<void> add_f(StudyResult& out) {
    const auto& f = find_published(trapezoids, "F");
    const ArrayMatch orientations[] = {{&f, "xf"}, {&f, "xf_printed"}};
    const auto ours = TRY(simulate_arrays(trapezoids.circuit, orientations));
    const char* names[] = {"F, the short transistor at the drain as in the text", "F, the short transistor at the source as in table 13"};
    for (std::size_t k = 0; k < 2; ++k) {
        out.next_kind = k == 0 ? ClaimKind::identity : ClaimKind::misprint;  // the first is F of the table once more
        const auto& a = ours[k];
        out.claim(fmt::format("{}: I_D", names[k]), a.I_D, "A").published_as(1e-6 * f.I_D, "table 14");
        auto& c =
            out.claim(fmt::format("{}: g_md", names[k]), a.g_md, "S").published_as(1e-10 * f.g_md, "table 14, divided by ten: errata U8");
        if (c.needs_explanation())
            c.explain(
                "one V_E for all lengths is too simple. The error is so large that the table does not tell which orientation is meant");
    }
    out.next_kind = {};
    return {};
}

Result<StudyResult> compute(const StudyOptions&) {
    const auto found = simulate_arrays(trapezoids);
    const auto rectangular = simulate_arrays(rectangles);
    TRY(check_all(found, rectangular));
    StudyResult out;
    add_small_signals(out, trapezoids, *found);
    TRY(add_f(out));
    out.claim("G3's drain current over A's", (*found)("G3").I_D / (*rectangular)("A").I_D)
        .derived_as(find_published(trapezoids, "G3").I_D / find_published(rectangles, "A").I_D, "thesis B.2: similar; tables 14 and 11");
    add_sum_rule(out, trapezoids, 1e-9, "errata U8: a tenth of the printed value, in nS");
    out.next_kind = ClaimKind::identity;
    double worst = 0;
    for (const auto& a : *found) worst = std::max(worst, std::abs((a.g_mg + a.g_md + a.g_mb) / a.g_ms - 1));
    out.claim("simulated: largest difference of g_mg + g_md + g_mb from g_ms", 100 * worst, "%")
        .allow_max(1e-4, "eq. 27, to the accuracy of the solution");
    return out;
}

const Study study{
    "table14", "Currents and small signals of the trapezoidal arrays",
    "Five arrays at V_G = V_D = 0.5 V; the sums of their slopes show that the column g_md is ten times too large. Thesis B.2, table 14",
    ClaimKind::fitted, compute};

}  // namespace corpuscle::studies::table14
