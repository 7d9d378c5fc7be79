// Eq. 34 to 41: mirrors with parallel arrays on one side and series arrays on the other, and the current-splitting mirror. Every unit
// transistor is simulated, with the simple model and with the process card. The equations are interpreted as in errata C1 to C6.

#include <fmt/format.h>
#include <cmath>

#include "reproduction/claims/check_all.hpp"
#include "reproduction/claims/studies.hpp"
#include "reproduction/claims/study_netlist.hpp"
#include "reproduction/thesis/array_text.hpp"

namespace corpuscle::studies::eq34_41 {

constexpr double I_in = 100e-9, supply = 0.7, V_out = 0.35;  // A, V
constexpr int sizes[] = {4, 8, 16};

constexpr double unit_length = 0.5e-6;  // m

/// V_E (V/m) of the model nch: Early voltage over channel length.
double V_E_of(const circuit::Circuit& circuit) {
    for (const auto& m : circuit.models)
        if (m.name == "nch") return m.values.at("ve");
    return Claim::none;
}

std::string unit_transistor(const std::string& model) { return fmt::format("0 {} w=1.5u l=0.5u", model); }
std::string common_lines(std::string_view card, double current) {
    return fmt::format("mirror\n{}iin 0 in {:g}\nvdd vdd 0 {:g}\nvout out 0 {:g}\n", card, current, supply, V_out);
}

/// A parallel-series mirror: M_A, the input, is n unit transistors in parallel; M_B, the output, is n in series. `current` is I_in (A).
Result<NetlistResult> simulate_parallel_series(std::string_view card, const std::string& model, int n, double current = I_in) {
    const auto unit = unit_transistor(model);
    return run_study_netlist(
        {common_lines(card, current) + array_lines("a", "in", "in", "0", n, 1, unit) + array_lines("b", "out", "in", "0", 1, n, unit),
         {},
         ".op\n.tf i(vout) vout"});
}

/// Drain currents (A) of M_B, M_C and M_D in a current-splitting mirror; the thesis writes I_DB, I_DC and I_DD.
struct SplitCurrents {
    double I_B, I_C, I_out;
};
/// M_A and M_C are n unit transistors in parallel, M_B and M_D n in series. The currents of M_C and M_D are those of vdd and vout.
Result<SplitCurrents> simulate_split(std::string_view card, const std::string& model, int n) {
    const auto unit = unit_transistor(model);
    const auto found =
        run_study_netlist({common_lines(card, I_in) + "vb yb y 0\n" + array_lines("a", "in", "in", "0", n, 1, unit) +
                               array_lines("b", "y", "in", "0", 1, n, unit) + array_lines("c", "vdd", "in", "yb", n, 1, unit) +
                               array_lines("d", "out", "in", "yb", 1, n, unit),
                           {},
                           ".op"});
    if (!found) return found.error();
    return SplitCurrents{found->operating_point("i(vb)"), -found->operating_point("i(vdd)"), -found->operating_point("i(vout)")};
}

constexpr const char* length_modulation =
    "the parallel diodes have a larger drain-source voltage than the series arrays, and length modulation increases their current";

Result<void> add_parallel_series(StudyResult& out) {
    for (const int n : sizes) {
        const auto simple = simulate_parallel_series(simple_card, "plain", n),
                   with_process_card = simulate_parallel_series(process_card, "nch", n);
        TRY(check_all(simple, with_process_card));
        const auto prefix = fmt::format("parallel-series, N = {}: I_in/I_out, ", n);
        out.claim(prefix + "equations only", I_in / -simple->operating_point("i(vout)"))
            .derived_as(n * n, "thesis eq. 34; errata C1")
            .of_kind(ClaimKind::identity);
        auto& c = out.claim(prefix + "with the process card", I_in / -with_process_card->operating_point("i(vout)"))
                      .derived_as(n * n, "thesis eq. 34")
                      .of_kind(ClaimKind::identity);
        if (c.needs_explanation()) c.explain(length_modulation);
        const double I = -with_process_card->operating_point("i(vout)"), G_o = -with_process_card->derivative("i(vout)", "vout");
        auto& early_claim = out.claim(fmt::format("N = {}: V_A = I_out/G_o - V_out, with the process card", n), I / G_o - V_out, "V");
        early_claim.derived_as(V_E_of(*with_process_card->circuit) * unit_length * n,
                               "thesis eq. 36 with V_E of the process card and L of N unit transistors");
        if (early_claim.needs_explanation())
            early_claim.explain(
                "in a stack of N only the unit transistor at the drain has length modulation, so the effect is less than 1/N of a single "
                "transistor's");
    }
    return {};
}

Result<void> add_split(StudyResult& out) {
    StudyPlot plot{"Attenuation of a current-splitting mirror over N", "N", "I_in/I_out over N^4", {}};
    StudyCurve by_40, exact, simple_line, process_line;  // over N^4
    for (const int n : sizes) {
        const auto simple = simulate_split(simple_card, "plain", n), with_process_card = simulate_split(process_card, "nch", n);
        TRY(check_all(simple, with_process_card));
        const double N2 = n * n, by_38_39 = N2 * (N2 + 2);
        const auto prefix = fmt::format("current splitting, N = {}: ", n);
        out.claim(prefix + "I_DC + I_DD over I_DB, equations only", (simple->I_C + simple->I_out) / simple->I_B)
            .derived_as(1, "thesis eq. 37")
            .of_kind(ClaimKind::identity);
        out.claim(prefix + "I_in/I_DB, equations only", I_in / simple->I_B)
            .derived_as(n * (1.0 / n + n + 1.0 / n) / ((n + 1.0 / n) / n), "thesis eq. 38")
            .of_kind(ClaimKind::identity);
        out.claim(prefix + "I_DC/I_out, equations only", simple->I_C / simple->I_out)
            .derived_as(N2, "thesis eq. 39; errata C5: exact in saturation")
            .of_kind(ClaimKind::identity);
        out.claim(prefix + "I_in/I_out, equations only", I_in / simple->I_out)
            .derived_as(by_38_39, "eq. 38 and 39: N^2 (N^2 + 2); errata C6")
            .of_kind(ClaimKind::identity);
        auto& error_claim = out.claim(prefix + "excess of I_in/I_out over eq. 40",
                                      100 * (simple->I_out > 0 ? I_in / simple->I_out / (N2 * N2) - 1 : Claim::none), "%");
        error_claim.of_kind(ClaimKind::identity).derived_as(200 / N2, "errata C6: 2/N^2, because S_C >> S_B + S_D is only approximate");
        auto& against_41 = out.claim(prefix + "I_in/I_out, equations only, against eq. 41", I_in / simple->I_out)
                               .derived_as(N2 * N2, "thesis eq. 41: N^4")
                               .of_kind(ClaimKind::identity);
        if (against_41.needs_explanation()) against_41.explain("eq. 40 assumes S_C >> S_B + S_D: errata C6");
        auto& c =
            out.claim(prefix + "I_in/I_out, with the process card", I_in / with_process_card->I_out).derived_as(by_38_39, "eq. 38 and 39");
        if (c.needs_explanation()) c.explain(length_modulation);
        by_40.x.push_back(n), by_40.y.push_back(1), exact.x.push_back(n), exact.y.push_back(by_38_39 / (N2 * N2));
        simple_line.x.push_back(n), simple_line.y.push_back(I_in / simple->I_out / (N2 * N2)), process_line.x.push_back(n),
            process_line.y.push_back(I_in / with_process_card->I_out / (N2 * N2));
        // for an attenuation of N^4 a parallel-series mirror needs N^2 in parallel and N^2 in series
        const double units = 4.0 * n, of_parallel_series = 2.0 * n * n;
        auto& count_claim = out.claim(fmt::format("number of unit transistors of a current-splitting mirror over that of a parallel-series "
                                                  "mirror of the same attenuation, N = {}",
                                                  n),
                                      units / of_parallel_series);
        count_claim.derived_as(0.5, "thesis C.2: half as many").of_kind(ClaimKind::arithmetic);
        if (count_claim.needs_explanation())
            count_claim.explain("4 N unit transistors against 2 N^2 for 1/N^4: half at N = 4, less for larger N");
    }
    out.plots.push_back(plot.add("eq. 41, N^4", by_40)
                            .add("eq. 38 and 39", exact)
                            .points("equations only, simulated", simple_line)
                            .points("with the process card", process_line));
    return {};
}

/// (35) as corrected, for a 1 to 1 mirror (A_I = 1): at V_out = V_in the mirror is exact, so G_o multiplies V_out - V_in, not V_out.
Result<void> add_output(StudyResult& out) {
    const auto found = TRY(run_study_netlist(
        {fmt::format("mirror\n{}iin 0 in {:g}\nma in in 0 0 nch w=1.5u l=0.5u\nmb out in 0 0 nch w=1.5u l=0.5u\nvout out 0 0.35\n",
                     process_card, I_in),
         {},
         ".op\n.dc vout 0.2 0.7 10m"}));
    const auto I = found.curve("dc", "i(vout)").scaled(1, -1);
    const double V_in = found.operating_point("v(in)"), G_o = I.slope_at(0.35), at = 0.65;
    out.claim("1 to 1: I_out/I_in at V_out = V_in, with the process card", I.at(V_in) / I_in)
        .derived_as(1, "errata C2")
        .of_kind(ClaimKind::identity);
    out.claim("1 to 1: I_out at 0.65 V from A_I I_in + G_o (V_out - V_in), over that of the simulated mirror",
              (I_in + G_o * (at - V_in)) / I.at(at))
        .derived_as(1, "eq. 35 as corrected by errata C2")
        .of_kind(ClaimKind::identity);
    out.claim("1 to 1: I_out at 0.65 V from A_I I_in + G_o V_out, over that of the simulated mirror", (I_in + G_o * at) / I.at(at))
        .derived_as(1, "thesis eq. 35")
        .of_kind(ClaimKind::identity);
    out.claim_true("eq. 35 as corrected is closer",
                   std::abs((I_in + G_o * (at - V_in)) - I.at(at)) < std::abs((I_in + G_o * at) - I.at(at)), "errata C2")
        .of_kind(ClaimKind::identity);
    return {};
}

Result<StudyResult> compute(const StudyOptions&) {
    StudyResult out;
    for (const auto add : {add_parallel_series, add_output, add_split}) TRY(add(out));
    out.note(
        "\"Greater current gain\" (C.2) means greater attenuation: A_I = 1/N^2 (errata C4). R_o and R_out are the same quantity (C3).");
    return out;
}

const Study study{"eq34-41", "Current-dividing mirrors",
                  "Division by N^2 with parallel and series arrays, and by almost N^4 with current splitting. Thesis C.1, C.2, eq. 34 to "
                  "41; errata C1 to C6",
                  ClaimKind::predicted, compute};

}  // namespace corpuscle::studies::eq34_41
