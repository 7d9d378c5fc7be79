// Table 13: sizes of the trapezoidal arrays, and eq. 32.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "reproduction/claims/check_all.hpp"
#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/arrays.hpp"

namespace corpuscle::studies::table13 {

Result<StudyResult> compute(const StudyOptions&) {
    const auto found = simulate_arrays(trapezoids);
    const auto rectangular = simulate_arrays(rectangles);
    TRY(check_all(found, rectangular));
    const auto& ours = *found;
    StudyResult out;
    add_sizes(out, trapezoids, ours);
    const std::string source = "thesis B.2";
    const auto A = [&](const char* name) { return ours(name).A; };
    out.claim("E's active area over G1's", A("E") / A("G1")).published_as(4, source + ": about 4; by errata U18 3.63");
    out.claim_true("G1, G2 and G3 have the same active area",
                   std::abs(A("G1") / A("G2") - 1) < 1e-9 && std::abs(A("G1") / A("G3") - 1) < 1e-9, source);
    const auto& A_T = [&](const char* name) { return ours(name).A_T; };
    out.claim_true("E, G1, G2 and G3 have the same total area by the rule of table 10",
                   std::abs(A_T("G1") / A_T("E") - 1) < 1e-9 && A_T("G1") == A_T("G2") && A_T("G1") == A_T("G3"), source);
    out.claim("G1's S_eq over that of A, one of its eight unit transistors in series", ours("G1").S / (*rectangular)("A").S)
        .derived_as(0.125, source + ": a rectangular series array");
    out.claim("G3's S_eq over A's", ours("G3").S / (*rectangular)("A").S).allow_range(0.8, 1.25, source + ": similar (0.8 to 1.25 here)");
    out.note(
        "F's two transistors have different lengths. Its rectangle is computed as two transistors of their mean length with the usual "
        "spacing. F's two channels are closer together than that, so the computed rectangle is too wide, and the published A_T is "
        "smaller.");
    out.note(
        "Table 13 calls F's transistor of 4.79 um M_D, and G1's single unit transistor above its seven M_S (errata U17, U17a). S_eq and "
        "areas are the same for both namings.");
    return out;
}

const Study study{"table13", "Sizes of the trapezoidal arrays",
                  "Equivalent aspect ratios, active and total areas of five arrays with equal total area. Thesis B.2, eq. 32, table 13",
                  ClaimKind::fitted, compute};

}  // namespace corpuscle::studies::table13
