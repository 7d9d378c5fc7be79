// Eq. 34 to 41: mirrors whose arrays are parallel on one side and in series on the other, and the one that splits its current; unit by
// unit, in the plain model and with the circuits' card. The errata's readings: C1 to C6.

#include <fmt/format.h>
#include <cmath>

#include "study/deck.hpp"
#include "study/studies.hpp"
#include "study/thesis/array_text.hpp"

namespace corpuscle::studies::eq34_41 {

constexpr double I_in = 100e-9, supply = 0.7, V_out = 0.35;  // A, V
constexpr int sizes[] = {4, 8, 16};

constexpr double unit_length = 0.5e-6;  // m

double V_E_of(const circuit::Circuit& circuit) {
    for (const auto& m : circuit.models)
        if (m.name == "nch") return m.values.at("ve");
    return Claim::none;
}

std::string unit_of(const std::string& model) { return fmt::format("0 {} w=1.5u l=0.5u", model); }
std::string common(std::string_view card, double current) {
    return fmt::format("mirror\n{}iin 0 in {:g}\nvdd vdd 0 {:g}\nvout out 0 {:g}\n", card, current, supply, V_out);
}

/// M_A is n units in parallel, M_B n in series.
Result<Found> parallel_series(std::string_view card, const std::string& model, int n, double current = I_in) {
    const auto unit = unit_of(model);
    return found_in({common(card, current) + units_text("a", "in", "in", "0", n, 1, unit) + units_text("b", "out", "in", "0", 1, n, unit),
                     {},
                     ".op\n.tf i(vout) vout"});
}

/// M_A and M_C are n in parallel, M_B and M_D n in series. The currents of M_C and M_D are those of vdd and vout.
struct Split {
    double I_B, I_C, I_out;
};
Result<Split> split(std::string_view card, const std::string& model, int n) {
    const auto unit = unit_of(model);
    const auto found = found_in({common(card, I_in) + "vb yb y 0\n" + units_text("a", "in", "in", "0", n, 1, unit) +
                                     units_text("b", "y", "in", "0", 1, n, unit) + units_text("c", "vdd", "in", "yb", n, 1, unit) +
                                     units_text("d", "out", "in", "yb", 1, n, unit),
                                 {},
                                 ".op"});
    if (!found) return found.error();
    return Split{found->at_rest("i(vb)"), -found->at_rest("i(vdd)"), -found->at_rest("i(vout)")};
}

constexpr const char* of_card = "the parallel diodes bear more voltage than the arrays in series, and are modulated by it";

Result<void> put_parallel_series(Outcome& out) {
    for (const int n : sizes) {
        const auto plain = parallel_series(plain_card, "plain", n), whole = parallel_series(whole_card, "nch", n);
        if (!plain || !whole) return plain ? whole.error() : plain.error();
        const auto what = fmt::format("Parallel-series, N = {}: I_in/I_out, ", n);
        out.claim(what + "the equations alone", I_in / -plain->at_rest("i(vout)")).held_to(n * n, "thesis eq. 34; errata C1");
        auto& c = out.claim(what + "with the card", I_in / -whole->at_rest("i(vout)")).held_to(n * n, "thesis eq. 34");
        if (c.needs_reason()) c.because(of_card);
        const double I = -whole->at_rest("i(vout)"), G_o = -whole->by("i(vout)", "vout");
        auto& early = out.claim(fmt::format("N = {}: V_A = I_out/G_o - V_out, with the card", n), I / G_o - V_out, "V");
        early.held_to(V_E_of(*whole->circuit) * unit_length * n, "thesis eq. 36 with the card's V_E and L of N units");
        if (early.needs_reason())
            early.because("the unit at the drain alone is modulated, and being modulated it has less than its share of the stack");
    }
    return {};
}

Result<void> put_split(Outcome& out) {
    Plot plot{"Attenuation of a splitting mirror along N", "N", "I_in/I_out over N^4", {}};
    Line by_40, exact, plain_line, whole_line;
    for (const int n : sizes) {
        const auto plain = split(plain_card, "plain", n), whole = split(whole_card, "nch", n);
        if (!plain || !whole) return plain ? whole.error() : plain.error();
        const double N2 = n * n, by_38_39 = N2 * (N2 + 2);
        const auto what = fmt::format("Splitting, N = {}: ", n);
        out.claim(what + "I_DC + I_DD over I_DB, the equations alone", (plain->I_C + plain->I_out) / plain->I_B)
            .held_to(1, "thesis eq. 37");
        out.claim(what + "I_in/I_DB, the equations alone", I_in / plain->I_B)
            .held_to(n * (1.0 / n + n + 1.0 / n) / ((n + 1.0 / n) / n), "thesis eq. 38");
        out.claim(what + "I_DC/I_out, the equations alone", plain->I_C / plain->I_out)
            .held_to(N2, "thesis eq. 39; errata C5: exact in saturation");
        out.claim(what + "I_in/I_out, the equations alone", I_in / plain->I_out)
            .held_to(by_38_39, "eq. 38 and 39: N^2 (N^2 + 2); errata C6");
        auto& high =
            out.claim(what + "eq. 40 is high by", 100 * (plain->I_out > 0 ? I_in / plain->I_out / (N2 * N2) - 1 : Claim::none), "%");
        high.held_to(200 / N2, "errata C6: 2/N^2, for S_C >> S_B + S_D is not that much greater");
        auto& printed =
            out.claim(what + "I_in/I_out, the equations alone, beside eq. 41", I_in / plain->I_out).held_to(N2 * N2, "thesis eq. 41: N^4");
        if (printed.needs_reason()) printed.because("eq. 40 takes S_C >> S_B + S_D: errata C6");
        auto& c = out.claim(what + "I_in/I_out, with the card", I_in / whole->I_out).held_to(by_38_39, "eq. 38 and 39");
        if (c.needs_reason()) c.because(of_card);
        by_40.x.push_back(n), by_40.y.push_back(1), exact.x.push_back(n), exact.y.push_back(by_38_39 / (N2 * N2));
        plain_line.x.push_back(n), plain_line.y.push_back(I_in / plain->I_out / (N2 * N2)), whole_line.x.push_back(n),
            whole_line.y.push_back(I_in / whole->I_out / (N2 * N2));
        const double units = 4.0 * n, of_parallel_series = 2.0 * n * n;  // of the same attenuation: N^2 in parallel and in series
        auto& half = out.claim(fmt::format("Units of a splitting mirror over those of a parallel-series one of its attenuation, N = {}", n),
                               units / of_parallel_series);
        half.held_to(0.5, "thesis C.2: half as many");
        if (half.needs_reason()) half.because("4 N units against 2 N^2 for 1/N^4: half at N = 4, fewer for more");
    }
    out.plots.push_back(plot.add("eq. 41, N^4", by_40)
                            .add("eq. 38 and 39", exact)
                            .points("the equations alone, solved", plain_line)
                            .points("with the card", whole_line));
    return {};
}

/// (35) as corrected: at V_out = V_in the mirror is exact, so that what counts is the difference.
Result<void> put_output(Outcome& out) {
    const auto found =
        found_in({fmt::format("mirror\n{}iin 0 in {:g}\nma in in 0 0 nch w=1.5u l=0.5u\nmb out in 0 0 nch w=1.5u l=0.5u\nvout out 0 0.35\n",
                              whole_card, I_in),
                  {},
                  ".op\n.dc vout 0.2 0.7 10m"});
    if (!found) return found.error();
    const auto I = found->line("dc", "i(vout)").times(1, -1);
    const double V_in = found->at_rest("v(in)"), G_o = I.slope_at(0.35), at = 0.65;
    out.claim("1 to 1: I_out/I_in at V_out = V_in, with the card", I.at(V_in) / I_in).held_to(1, "errata C2");
    out.claim("1 to 1: I_out at 0.65 V by A_I I_in + G_o (V_out - V_in), over that of the solved mirror",
              (I_in + G_o * (at - V_in)) / I.at(at))
        .held_to(1, "eq. 35 as errata C2 has it");
    out.claim("1 to 1: the same by A_I I_in + G_o V_out", (I_in + G_o * at) / I.at(at)).held_to(1, "thesis eq. 35");
    out.finds("Eq. 35 as corrected is the nearer one",
              std::abs((I_in + G_o * (at - V_in)) - I.at(at)) < std::abs((I_in + G_o * at) - I.at(at)), "errata C2");
    return {};
}

Result<Outcome> work(const StudyOptions&) {
    Outcome out;
    for (const auto put : {put_parallel_series, put_output, put_split})
        if (auto ok = put(out); !ok) return ok.error();
    out.note("\"Greater current gain\" (C.2) means greater attenuation: A_I = 1/N^2 (errata C4). R_o and R_out are one quantity (C3).");
    return out;
}

const Study study{
    "eq34-41", "Mirrors that divide",
    "By N^2 with parallel and series arrays, by N^4, or nearly, with the current split. Thesis C.1, C.2, eq. 34 to 41; errata C1 to C6",
    work};

}  // namespace corpuscle::studies::eq34_41
