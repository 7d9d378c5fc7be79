// Table 15: ratios and mismatch of the trapezoidal arrays, and the statements of the text on them.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "reproduction/claims/check_all.hpp"
#include "reproduction/claims/studies.hpp"
#include "reproduction/claims/study_netlist.hpp"
#include "reproduction/thesis/arrays.hpp"

namespace corpuscle::studies::table15 {

void add_errata(StudyResult& out) {
    out.next_kind = ClaimKind::arithmetic;
    add_ratio_rule(out, trapezoids, 1e-9, "errata U8: g_md is a tenth of the value in table 14");
    for (const auto& a : published_trapezoids) {
        out.claim(fmt::format("{}: g_mg over A (table 13), as printed", a.name), 1e-6 * a.g_mg / a.A, "S/um^2")
            .published_as(1e-6 * a.g_by_A, "table 15, nS corrected to uS: errata U9");
        out.claim(fmt::format("{}: g_mb/g_mg by table 14 as printed", a.name), a.g_mb / a.g_mg)
            .published_as(a.bulk_ratio, "table 15, errata U5");
    }
    out.next_kind = {};
}

void add_text(StudyResult& out, const SimulatedArrays& ours, const SimulatedArrays& rectangular) {
    const std::string source = "thesis B.2";
    const auto gain = [&](const char* name) { return ours(name).gain(); };
    const auto V_A = [&](const char* name) { return ours(name).V_A(); };
    out.claim("G3's V_A over A's", V_A("G3") / rectangular("A").V_A()).published_as(10, source);
    out.claim("F's V_A over E's", V_A("F") / V_A("E"))
        .derived_as(33.38 / 37.82, source + ": similar; table 15")
        .explain_if_needed("one V_E for all lengths is too simple: F's short transistor at the drain has more length modulation here");
    out.claim_true("F's gain is slightly lower than E's", gain("F") < gain("E"), source);
    out.claim_true("G1's gain is considerably smaller than E's", gain("G1") < gain("E") - 3, source + "; 3 dB here, 7 dB published");
    const auto highest_gain = std::max_element(ours.begin(), ours.end(), [](const auto& a, const auto& b) { return a.gain() < b.gain(); });
    out.claim_true("G2 has the largest gain", highest_gain->published->name == std::string_view("G2"), source);
}

/// sigma: from simulate_mismatch, in the order of published_trapezoids; sigma_of_A: of A of table 12. All in %.
void add_mismatch_text(StudyResult& out, const std::vector<double>& sigma, double sigma_of_A) {
    const std::string source = "thesis B.2";
    const auto sigma_of = [&](const char* name) {
        return sigma[static_cast<std::size_t>(&find_published(trapezoids, name) - published_trapezoids)];
    };
    out.claim("E's standard deviation over G1's", sigma_of("E") / sigma_of("G1")).derived_as(2.36 / 5.77, source + ": half; table 15");
    out.claim("E's standard deviation over G1's, by the areas of table 13", std::sqrt(0.6048 / 2.1924))
        .derived_as(2.36 / 5.77, "errata U18: 3.63 times the area")
        .of_kind(ClaimKind::arithmetic)
        .explain("in addition E is in stronger inversion with a lower g_mg/I_D");
    out.claim_true("G3's standard deviation is much larger than G1's and G2's",
                   sigma_of("G3") > 1.5 * std::max(sigma_of("G1"), sigma_of("G2")), source + "; a factor of 1.5 here, 2 as published");
    auto& g3 = out.claim("G3's standard deviation over A's", sigma_of("G3") / sigma_of_A)
                   .derived_as(14.9 / 15.6, source + ": similar; tables 15 and 12");
    if (g3.needs_explanation()) g3.explain("G3's unit transistor at the source is not fully saturated");
    out.claim("G2's standard deviation over G1's", sigma_of("G2") / sigma_of("G1"))
        .derived_as(7.46 / 5.77, source + ": slightly more; table 15");
}

/// Claims on F in both orientations (errata U17). The arrays are those of the tables (E first, then F with the short transistor at the
/// drain, as in the text), and at the end F with the short transistor at the source, as labelled in table 13. The error of V_A is too large
/// for these rows to tell which of them the thesis simulated.
void add_f(StudyResult& out, const SimulatedArrays& orientations, const std::vector<double>& sigma) {
    const auto &e = orientations[0], &text = orientations[1], &table = orientations.back();
    const auto& f = *text.published;
    const double sigma_of_table = sigma.back();
    const auto add_gain_claim = [&](const char* terminal, const SimulatedArray& array) -> Claim& {
        return out.claim(fmt::format("F, short transistor at the {}: gain of E minus gain of F", terminal), e.gain() - array.gain(), "dB")
            .derived_as(find_published(trapezoids, "E").gain - f.gain, "thesis B.2: slightly lower; table 15");
    };
    out.claim("F, short transistor at the source as in table 13: standard deviation of I_D", sigma_of_table, "%")
        .published_as(f.sigma, "table 15")
        .of_kind(ClaimKind::misprint);
    add_gain_claim("source as in table 13", table)
        .of_kind(ClaimKind::misprint)
        .explain_if_needed("a small difference of two gains, which depend on V_A; one V_E for all lengths is too simple");
    add_gain_claim("drain as in the text", text)
        .explain_if_needed(
            "the short transistor has the drain voltage and full length modulation: one V_E for all lengths gives short transistors too "
            "much of it (tables 11 and 14)");
}

/// "The solution is to increase M_D width": F's short transistor at the drain, eight times as wide.
Result<void> add_wider(StudyResult& out, double gain_of_f, double gain_of_e) {
    const auto found = TRY(run_study_netlist({trapezoids.circuit, {"xf.mg1.m=8", "xf.md1.m=8"}, ".op\n.tf i(xf.vg) vi\n.tf i(xf.vd) vi"}));
    const double gain = 20 * std::log10(found.derivative("i(xf.vg)", "vi") / found.derivative("i(xf.vd)", "vi"));
    out.claim("F, its transistor at the drain eight times as wide: increase of the gain", gain - gain_of_f, "dB")
        .allow_min(0, "thesis B.2: a wider M_D is the solution");
    out.claim("F, its transistor at the drain eight times as wide: gain minus E's", gain - gain_of_e, "dB").allow_min(0, "thesis B.2");
    if (auto& c = out.claims.back(); c.needs_explanation())
        c.explain("the length modulation of the short transistor at the drain remains, with one V_E for all lengths");
    return {};
}

Result<StudyResult> compute(const StudyOptions&) {
    auto matches = all_matches(trapezoids);  // and F in the other orientation, at the end
    matches.push_back({&find_published(trapezoids, "F"), "xf_printed"});
    auto ours = simulate_arrays(trapezoids.circuit, matches);
    const auto rectangular = simulate_arrays(rectangles);
    TRY(check_all(ours, rectangular));
    auto sigma = simulate_mismatch(trapezoids.circuit, matches);
    const ArrayMatch a{&find_published(rectangles, "A"), "xa"};
    const auto sigma_of_A = simulate_mismatch(rectangles.circuit, {&a, 1});
    TRY(check_all(sigma, sigma_of_A));
    StudyResult orientations;
    add_f(orientations, *ours, *sigma);
    TRY(add_wider(orientations, (*ours)[1].gain(), (*ours)[0].gain()));
    ours->pop_back(), sigma->pop_back();
    StudyResult out;
    add_ratios(out, trapezoids, *ours);
    add_mismatch(out, trapezoids, *ours, *sigma);
    add_errata(out);
    add_text(out, *ours, *rectangular);
    add_mismatch_text(out, *sigma, sigma_of_A->front());
    out.claims.insert(out.claims.end(), orientations.claims.begin(), orientations.claims.end());
    return out;
}

const Study study{
    "table15", "Ratios and mismatch of the trapezoidal arrays",
    "g_mg/I_D, Early voltage, gain, n - 1, g_mg per area and mismatch (1000 samples in the thesis, 2000 here). Thesis B.2, table 15",
    ClaimKind::fitted, compute};

}  // namespace corpuscle::studies::table15
