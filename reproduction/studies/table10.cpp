// Table 10: sizes of the rectangular arrays, and the statements of the text on them.

#include <fmt/format.h>
#include <algorithm>

#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/arrays.hpp"

namespace corpuscle::studies::table10 {

/// C1's active area from other published numbers; table 10 prints a different one.
void add_erratum(StudyResult& out, const SimulatedArrays& ours) {
    const auto& c1 = find_published(rectangles, "C1");
    out.next_kind = ClaimKind::arithmetic;
    const std::string source = "errata U11, C1's A = 1.0800";
    out.claim("C1: A from A_T and A/A_T as printed", c1.A_T * c1.area_ratio, "um^2").derived_as(1.0080, source);
    out.claim("C1: A from g_mg (table 11) and g_mg/A (table 12) as printed", c1.g_mg / c1.g_by_A, "um^2").derived_as(1.0080, source);
    out.claim_true("C1: W L is 1.0080 um^2, not 1.0800", std::abs(ours("C1").A * 1e12 - 1.0080) < 5e-5, source);
    out.next_kind = {};
}

Result<StudyResult> compute(const StudyOptions&) {
    const auto ours = TRY(simulate_arrays(rectangles));
    StudyResult out;
    add_sizes(out, rectangles, ours);
    add_erratum(out, ours);

    const std::string source = "thesis B.1";
    const auto& arrays = ours;
    const auto compare_by = [](auto property) {
        return [property](const SimulatedArray& a, const SimulatedArray& b) { return property(a) < property(b); };
    };
    const auto by_S_eq = compare_by([](const SimulatedArray& a) { return a.S; });
    const auto by_area_ratio = compare_by([](const SimulatedArray& a) { return a.A / a.A_T; });
    out.claim_true("B1 has the lowest S_eq, D1 the highest",
                   std::min_element(arrays.begin(), arrays.end(), by_S_eq)->published->name == std::string_view("B1") &&
                       std::max_element(arrays.begin(), arrays.end(), by_S_eq)->published->name == std::string_view("D1"),
                   source);
    out.claim_true("C1 has the largest ratio of active to total area",
                   std::max_element(arrays.begin(), arrays.end(), by_area_ratio)->published->name == std::string_view("C1"), source);
    const double A_T = arrays("C1").A_T;
    out.claim_true("all except A have the same total area",
                   std::all_of(arrays.begin() + 1, arrays.end(), [&](const SimulatedArray& a) { return std::abs(a.A_T / A_T - 1) < 1e-9; }),
                   source);
    out.claim_true("B2, C2 and D2 have the same active area, and less than B1, C1 and D1",
                   std::abs(arrays("B2").A / arrays("C2").A - 1) < 1e-9 && std::abs(arrays("D2").A / arrays("C2").A - 1) < 1e-9 &&
                       arrays("B2").A < std::min({arrays("B1").A, arrays("C1").A, arrays("D1").A}),
                   source);
    out.claim("S_eq of A over S_eq of C2", arrays("A").S / arrays("C2").S).derived_as(1, source + ": the same S_eq");
    out.note(
        "A_T is the area of a rectangle around polysilicon and diffusion (errata U16: not its perimeter). Its margins are inferred from "
        "this table and table 13 as one rule: r rows by c columns take (r W + (r - 1) 0.28 um + 0.5 um)(c L + (c - 1) 0.54 um + 0.96 um).");
    return out;
}

const Study study{
    "table10", "Sizes of the rectangular arrays",
    "Equivalent aspect ratios, active and total areas of seven arrays, six of them with equal total area. Thesis B.1, table 10",
    ClaimKind::fitted, compute};

}  // namespace corpuscle::studies::table10
