// Eq. 31 to 33: an array acts as one transistor of its equivalent aspect ratio, and a mirror divides by the ratio of its two arrays. Every
// unit transistor is simulated.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/claims/study_netlist.hpp"
#include "reproduction/thesis/array_text.hpp"
#include "reproduction/thesis/arrays.hpp"

namespace corpuscle::studies::eq31_33 {

/// m columns of n unit transistors in series.
struct SubArray {
    int m, n;
    double S() const { return double(m) / n; }
    std::string text() const { return fmt::format("{}x{}", m, n); }
};
constexpr SubArray rectangles[] = {{1, 2}, {1, 4}, {2, 2}, {4, 1}, {1, 8}, {2, 8}, {16, 1}};
/// Pairs of the sub-array at the source and the one at the drain: G2 and G3 of table 13, the amplifier's (errata U19), the splitting
/// mirror's.
constexpr std::pair<SubArray, SubArray> trapezoids[] = {{{1, 4}, {4, 1}}, {{1, 1}, {7, 1}}, {{4, 4}, {16, 1}}, {{2, 4}, {8, 1}}};
/// The published current of this array over S (its S_eq) times that of array A, a single unit transistor; from tables 11 and 14. NaN if the
/// array is not in the tables. `name` is as in Array.
double published_ratio(const std::string& name, double S) {
    constexpr std::pair<const char*, const char*> rows[] = {{"1x4", "B2"}, {"2x2", "C2"},           {"4x1", "D2"},
                                                            {"1x8", "G1"}, {"1x4 under 4x1", "G2"}, {"1x1 under 7x1", "G3"}};
    const auto& [first, second] = std::pair(corpuscle::rectangles, corpuscle::trapezoids);
    for (const auto& [array, row] : rows)
        if (name == array) return find_published(*row == 'G' ? second : first, row).I_D / (S * find_published(first, "A").I_D);
    return Claim::none;
}

constexpr double W = 0.42, L = 0.18;  // um: the unit transistor of tables 10 and 13

/// The current of an array (netlist lines) over that of one transistor of aspect ratio S, at the bias points of the .step lines `steps`; at
/// V_G = V_D = 0.5 V if there are none.
Result<std::vector<double>> ratios(std::string_view card, const std::string& model, const std::string& array, double S,
                                   const std::string& steps) {
    const auto all = TRY(run_study_variants(
        {fmt::format("array\n{}{}m1 e g 0 0 {} w={:.15g}u l={}u\nvg g 0 {{vg}}\nvd d 0 {{vd}}\nve e 0 {{vd}}\n.param vg=0.5 vd=0.5\n", card,
                     array, model, S * W, L),
         {},
         ".op\n" + steps}));
    std::vector<double> out;
    for (const auto& f : all) out.push_back(f.operating_point("i(vd)") / f.operating_point("i(ve)"));
    return out;
}

/// An array of the study: rectangular, or two rectangular ones in series.
struct Array {
    std::string name, equation;
    double S;                                                    ///< S_eq by the equation
    std::string (*text)(const Array&, const std::string& rest);  ///< its netlist lines; rest: as in array_lines
    SubArray low, high;                                          ///< at the source and at the drain; a rectangle uses only `low`
};

std::string rectangle(const Array& a, const std::string& rest) { return array_lines("a", "d", "g", "0", a.low.m, a.low.n, rest); }
std::string trapezoid(const Array& a, const std::string& rest) {
    return array_lines("l", "y", "g", "0", a.low.m, a.low.n, rest) + array_lines("h", "d", "g", "y", a.high.m, a.high.n, rest);
}

std::vector<Array> arrays() {
    std::vector<Array> out;
    for (const auto& p : rectangles) out.push_back({p.text(), "eq. 31", p.S(), rectangle, p, p});
    for (const auto& [s, d] : trapezoids)
        out.push_back({fmt::format("{} under {}", s.text(), d.text()), "eq. 32", s.S() * d.S() / (s.S() + d.S()), trapezoid, s, d});
    return out;
}

/// (33): a mirror of two widths.
Result<void> add_mirror(StudyResult& out) {
    for (const double ratio : {0.25, 4.0}) {
        const auto found = TRY(run_study_netlist(
            {fmt::format("mirror\n{}iin 0 a 100n\nma a a 0 0 plain w=1.5u l=0.5u\nmb b a 0 0 plain w={}u l=0.5u\nvo b 0 0.35\n",
                         simple_card, 1.5 * ratio),
             {},
             ".op"}));
        out.claim(fmt::format("mirror of S_B/S_A = {}: I_out/I_in", ratio), -found.operating_point("i(vo)") / 100e-9)
            .derived_as(ratio, "thesis eq. 33");
    }
    return {};
}

Result<StudyResult> compute(const StudyOptions&) {
    StudyResult out;
    double worst = 0;
    for (const auto& a : arrays()) {
        const auto simple = TRY(ratios(simple_card, "plain", a.text(a, fmt::format("0 plain w={}u l={}u", W, L)), a.S,
                                       ".step param vg list 0.2 0.35 0.5 0.9 1.8\n.step param vd list 0.02 0.1 0.5"));
        for (const double r : simple) worst = std::max(worst, std::abs(r - 1));
        const auto with_process_card = TRY(ratios(process_card, "nch018", a.text(a, fmt::format("0 nch018 w={}u l={}u", W, L)), a.S, ""));
        const double published_value = published_ratio(a.name, a.S);
        out.claim(fmt::format("{}: current over that of one transistor of the unit's length and S_eq = {:.4g}, process card, 0.5 V", a.name,
                              a.S),
                  with_process_card.front())
            .derived_as(std::isnan(published_value) ? 1 : published_value,
                        fmt::format("thesis {}{}", a.equation, std::isnan(published_value) ? "" : "; value from tables 11 and 14"));
    }
    out.claim("equations only: largest error of all arrays, V_G 0.2 to 1.8 V, V_D 20 to 500 mV", 100 * worst, "%")
        .allow_max(1e-6, "thesis eq. 31 and 32, exact in eq. 21 to 25");
    TRY(add_mirror(out));
    out.note(
        "With the process card, as in tables 11 and 14, arrays carry less current than the equations give. One transistor of the unit's "
        "length has all of V_DS and its full length modulation; in an array only the transistor nearest to the drain is affected.");
    out.note(
        "Inversion levels divide along a stack as voltages do along resistors, so both equations are identities of the simple model, in "
        "triode and in saturation. A trapezoidal array is two rectangular arrays in series (errata U19).");
    return out;
}

const Study study{"eq31-33", "Arrays as single transistors",
                  "An array acts as one transistor of its equivalent aspect ratio. Thesis B.1, B.2, C.1, eq. 31 to 33; errata U19",
                  ClaimKind::identity, compute};

}  // namespace corpuscle::studies::eq31_33
