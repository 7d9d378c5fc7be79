// Errata of the thesis's appendices A to D (numbers U1 to U19 and C1 to C9) that no other study covers.

#include <fmt/format.h>
#include <cmath>

#include "circuit/cost/area.hpp"
#include "reproduction/claims/check_all.hpp"
#include "reproduction/claims/studies.hpp"
#include "reproduction/claims/study_netlist.hpp"
#include "reproduction/thesis/array_text.hpp"
#include "reproduction/thesis/arrays.hpp"

namespace corpuscle::studies::errata_arrays {

void add_tables(StudyResult& out) {
    const auto& a = find_published(rectangles, "A");
    out.claim("A: I_D/g_md by table 11, g_md in uS", a.I_D / a.g_md, "V").published_as(a.V_A, "table 12; errata U6: V_A is I_D/g_md");
    out.claim_true("A: g_md/I_D, as B.1 defines V_A, is not 2.10 V", std::abs(a.g_md / a.I_D / a.V_A - 1) > 0.5, "errata U6");
    out.claim("B2's V_A over A's, as printed", find_published(rectangles, "B2").V_A / a.V_A)
        .published_as(4, "thesis B.1, 4 times \"A1\"; by errata U15 A is meant");
    out.claim("C2's V_A over A's, as printed", find_published(rectangles, "C2").V_A / a.V_A)
        .published_as(2, "thesis B.1, 2 times \"A1\"; by errata U15 A is meant");
    out.claim("C1: A_T as an area", 1e12 * circuit::rectangle_area(1.12e-6, 0.90e-6, 1, 1), "um^2")
        .published_as(find_published(rectangles, "C1").A_T, "table 10; errata U16")
        .of_kind(ClaimKind::fitted);
    using Rule = circuit::RectangleRule;
    out.claim("C1: perimeter of that area's rectangle, um", 1e6 * 2 * (1.12e-6 + Rule::around_W + 0.90e-6 + Rule::around_L));
}

/// (U14) Published standard deviations of I_D over area, for arrays of equal inversion level.
void add_mismatch_by_area(StudyResult& out) {
    const auto& a = find_published(rectangles, "A");
    for (const char* name : {"B2", "C2", "D2"}) {
        const auto& p = find_published(rectangles, name);
        out.claim(fmt::format("{}: published standard deviation over A's", name), p.sigma / a.sigma)
            .derived_as(std::sqrt(a.A / p.A), "errata U14: inversely proportional to the square root of the area");
    }
    const auto &e = find_published(trapezoids, "E"), &g1 = find_published(trapezoids, "G1");
    out.claim("E's active area over G1's, as printed", e.A / g1.A).published_as(4, "thesis B.2; errata U18: 3.63");
    out.claim("G1's standard deviation over E's, as printed", g1.sigma / e.sigma)
        .published_as(2, "thesis B.2, half; 2.4 by errata U18")
        .explain("3.63 times the area, and E is in stronger inversion with a lower g_mg/I_D");
}

/// (U14) Mismatch of the current falls as the inversion level rises.
Result<void> add_mismatch_by_inversion(StudyResult& out) {
    // standard deviation of I_D (%) of A at this gate voltage: A_VT / sqrt(W L) times g_mg/I_D
    const auto sigma = [&](double V_G) -> Result<double> {
        const auto found = TRY(run_study_netlist(
            {fmt::format("slope\n{}vd d 0 1\nvg g 0 {}\nm1 d g 0 0 nch018 w=0.42u l=0.18u\n", process_card, V_G), {}, ".op"}));
        double A_VT = 0;
        for (const auto& m : found.circuit->models)
            if (m.name == "nch018") A_VT = m.values.at("avt");
        return 100 * A_VT / std::sqrt(0.42e-6 * 0.18e-6) * found.operating_info("m1", "g_mg") / found.operating_info("m1", "i_d");
    };
    const auto weak = sigma(0.25), strong = sigma(0.9);
    TRY(check_all(weak, strong));
    out.claim("A: standard deviation of I_D caused by threshold mismatch, at V_G = 0.25 V", *weak, "%");
    out.claim("A: standard deviation of I_D caused by threshold mismatch, at V_G = 0.9 V", *strong, "%")
        .allow_max(*weak, "errata U14: it falls as the inversion level rises")
        .of_kind(ClaimKind::identity);
    return {};
}

/// (U13) V_T does not depend on the drain voltage.
Result<void> add_threshold(StudyResult& out) {
    const auto found = TRY(run_study_variants(
        {fmt::format("drain\n{}vd d 0 {{vd}}\nvg g 0 0.3\nm1 d g 0 0 nch018 w=0.42u l=0.18u\n.param vd=0\n", process_card),
         {},
         ".op\n.step param vd list 0 0.5"}));
    const double at_0 = found.front().operating_info("m1", "v_t"), at_half = found.back().operating_info("m1", "v_t");
    out.claim("short unit transistor: V_T at V_D = 0.5 V minus V_T at V_D = 0", at_half - at_0, "V")
        .allow_range(-16e-3, 0, "errata U13: the largest drain-induced barrier lowering that g_md allows; the fit gives 0")
        .of_kind(ClaimKind::fitted);
    const auto V_T = [](const PublishedArrays& all, const char* name) { return 1e-3 * find_published(all, name).V_T; };
    out.claim_true(
        "published at V_D = 0: 441.4 mV at 5.22 um, 479.6 mV at 0.9 um, 531.7 mV at 0.18 um. V_T rises as L falls; drain-induced lowering "
        "would make it fall",
        V_T(trapezoids, "E") < V_T(rectangles, "B1") && V_T(rectangles, "B1") < V_T(rectangles, "A"), "errata U13");
    return {};
}

/// (C7) Appendix D prints V_B = V_D for the plain diode of fig. 48a; that would be the body-biased diode of fig. 48b.
Result<void> add_bulk(StudyResult& out) {
    const auto found = TRY(run_study_netlist(
        {fmt::format("diodes\n{}va a 0 0.3\nvs s a 0\nvd e a 0\nm1 s s 0 0 nch w=1.5u l=0.5u\nm2 e e 0 e nch w=1.5u l=0.5u\n",
                     process_card),
         {},
         ".op"}));
    // m1: bulk at the source; m2: bulk at the drain
    out.claim("current of a diode with V_B = V_D, as appendix D prints for fig. 48a, over that with V_B = V_S, at 0.3 V",
              found.operating_point("i(vd)") / found.operating_point("i(vs)"))
        .allow_min(2, "errata C7: V_B = V_D would be fig. 48b already")
        .of_kind(ClaimKind::misprint);
    return {};
}

Result<StudyResult> compute(const StudyOptions&) {
    StudyResult out;
    add_tables(out);
    add_mismatch_by_area(out);
    for (const auto add : {add_mismatch_by_inversion, add_threshold, add_bulk}) TRY(add(out));
    out.note(
        "The other errata are in these studies. U2, U4, U5: eq21-30. U7, U10, U13: table11. U5, U6, U12, U14: table12. U8: table14. U9, "
        "U17, U18: table15. U11, U16: table10. U19: eq31-33. C1 to C6: eq34-41. C8: eq42-44.");
    out.note(
        "Some errata concern wording and cannot be computed. U1: g_mg four times in the list of symbols. U3: \"gain\" for drain "
        "transconductance. U17a: the order of G1's rows. C3: R_o and R_out. C4: \"greater current gain\". C9: a shared p-substrate cannot "
        "be biased.");
    return out;
}

const Study study{"errata-arrays", "Misprints of appendices A to D",
                  "Evidence from sums, units and simulated circuits. Errata U1 to U19, C1 to C9", ClaimKind::arithmetic, compute};

}  // namespace corpuscle::studies::errata_arrays
