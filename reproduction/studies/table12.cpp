// Table 12: ratios and mismatch of the rectangular arrays, and the statements of the text on them.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/arrays.hpp"

namespace corpuscle::studies::table12 {

/// Errata of table 12: what its columns contain, computed from the printed numbers of table 11.
void add_errata(StudyResult& out) {
    out.next_kind = ClaimKind::arithmetic;
    add_ratio_rule(out, rectangles, 1e-9, "errata U6 and U7: V_A is I_D/g_md, and g_md in uS");
    for (const auto& a : published_rectangles)
        out.claim(fmt::format("{}: g_mb/g_mg by table 11 as printed", a.name), a.g_mb / a.g_mg)
            .published_as(a.bulk_ratio, "table 12, errata U5: not g_mg/g_mb");
    const auto& d1 = find_published(rectangles, "D1");
    out.claim("D1: g_mg/I_D by table 11 as printed", d1.g_mg / d1.I_D, "1/V").derived_as(18.07, "errata U12, instead of 18.02");
    out.next_kind = {};
}

void add_text(StudyResult& out, const SimulatedArrays& ours) {
    const std::string source = "thesis B.1";
    const auto V_A = [&](const char* name) { return ours(name).V_A(); };
    const auto printed_V_A = [&](const char* name) { return find_published(rectangles, name).V_A; };
    for (const auto& [name, factor] : {std::pair{"B2", 4.0}, {"C2", 2.0}}) {
        auto& c = out.claim(fmt::format("{}: V_A over A's, as the equivalent length", name), V_A(name) / V_A("A"))
                      .published_as(factor, source + fmt::format("; {:.2f} by its table", printed_V_A(name) / printed_V_A("A")));
        if (c.needs_explanation())
            c.explain(
                "in a stack of N only the unit transistor at the drain has length modulation, so the effect is less than 1/N of a single "
                "transistor's");
    }
    const auto gain = [](const SimulatedArray& a, const SimulatedArray& b) { return a.gain() < b.gain(); };
    const auto highest_gain = std::max_element(ours.begin(), ours.end(), gain);
    out.claim_true("B1 has the largest g_mg/g_md; B2 has a lower V_A than B1 at the same total area",
                   highest_gain->published->name == std::string_view("B1") && V_A("B1") > V_A("B2"), source);
    const double a = ours("A").g_by_I();
    double worst_difference = 0;
    for (const char* name : {"B2", "C2", "D2"}) worst_difference = std::max(worst_difference, std::abs(ours(name).g_by_I() / a - 1));
    out.claim("largest difference of g_mg/I_D of B2, C2 and D2 from A's", 100 * worst_difference, "%")
        .allow_max(5, source + ": the same g_mg/I_D (5 % here)");
    if (auto& c = out.claims.back(); c.needs_explanation())
        c.explain(
            "with velocity saturation and length modulation of the process card a unit transistor differs more from a stack than in the "
            "foundry's model");
    const auto slope_range =
        std::minmax_element(ours.begin(), ours.end(), [](const auto& x, const auto& y) { return x.bulk_ratio() < y.bulk_ratio(); });
    out.claim("slope factor n = 1 + g_mb/g_mg: largest of the seven over the smallest",
              (1 + slope_range.second->bulk_ratio()) / (1 + slope_range.first->bulk_ratio()))
        .derived_as(1.276 / 1.265, source + ": similar; table 12");
    out.claim("g_mg/A: D2's over B2's, of equal active area", ours("D2").g_by_A() / ours("B2").g_by_A())
        .derived_as(find_published(rectangles, "D2").g_by_A / find_published(rectangles, "B2").g_by_A,
                    source + ": widely different; table 12");
}

/// sigma: from simulate_mismatch, in the order of published_rectangles.
void add_mismatch_text(StudyResult& out, const SimulatedArrays& ours, const std::vector<double>& sigma) {
    const std::string source = "thesis B.1";
    const auto sigma_of = [&](const char* name) {
        return sigma[static_cast<std::size_t>(&find_published(rectangles, name) - published_rectangles)];
    };
    for (const char* name : {"B2", "C2", "D2"})
        out.claim(fmt::format("{}: standard deviation over A's, which has a quarter of its area", name), sigma_of(name) / sigma_of("A"))
            .derived_as(0.5, source + ": half; by errata U14 inversely proportional to the square root of the area, not proportional");
    const double smallest = *std::min_element(sigma.begin(), sigma.end());
    auto& c = out.claim_true("C1 has the smallest standard deviation", sigma_of("C1") == smallest, source);
    if (c.needs_explanation())
        c.explain(fmt::format(
            "B1's standard deviation is {:.2f} % and C1's {:.2f} %; their uncertainty of {:.1f} % does not separate them. By A_VT "
            "and A_IS of the model card they are {:.2f} and {:.2f} %",
            sigma_of("B1"), sigma_of("C1"), mismatch_uncertainty(), ours("B1").predicted_mismatch(ours("B1").g_by_I()),
            ours("C1").predicted_mismatch(ours("C1").g_by_I())));
}

Result<StudyResult> compute(const StudyOptions&) {
    const auto ours = TRY(simulate_arrays(rectangles));
    StudyResult out;
    add_ratios(out, rectangles, ours);
    const auto sigma = TRY(simulate_mismatch(rectangles));
    add_mismatch(out, rectangles, ours, sigma);
    add_errata(out);
    add_text(out, ours);
    add_mismatch_text(out, ours, sigma);
    return out;
}

const Study study{
    "table12", "Ratios and mismatch of the rectangular arrays",
    "g_mg/I_D, Early voltage, gain, n - 1, g_mg per area and mismatch (1000 samples in the thesis, 2000 here). Thesis B.1, table 12",
    ClaimKind::fitted, compute};

}  // namespace corpuscle::studies::table12
