// Fig. 47: the mirror that splits its current, 8x1 and 2x4 arrays as INVC and the summer have it; what the supply does to its output.

#include <fmt/format.h>
#include <cmath>

#include "study/deck.hpp"
#include "study/studies.hpp"

namespace corpuscle::studies::fig47 {

constexpr double I_in = 100e-9, supply = 0.7, step = 0.1;  // A, V; what the supply moves by
constexpr double S_A = 8, S_B = 0.5, S_C = 8, S_D = 0.5;   // in units: 8x1 and 2x4

Result<Outcome> work(const StudyOptions&) {
    const auto at = found_in({"split_mirror", {}, ".op\n.tf i(vout) vout\n.tf i(vout) vdd"});
    const auto supplied = found_in({"split_mirror", {"iin2=0"}, ".dc vdd 0.4 1.2 5m"});  // M_C alone on vdd
    const auto along = found_in({"split_mirror", {}, ".dc iin 1n 1u 1n"});
    if (!at || !along || !supplied) return !at ? at.error() : !along ? along.error() : supplied.error();
    Outcome out;
    const std::string source = "thesis C.2",
                      of_card = "the parallel diodes bear more voltage than the arrays in series, and are modulated by it";
    const double I = -at->at_rest("i(vout)"), exact = S_A * (S_B + S_C + S_D) / (S_B * S_D);
    out.claim("I_in/I_out, the equations alone", I_in / -at->at_rest("i(vout2)"))
        .held_to(exact, "thesis eq. 38 and 39, exact (errata C5, C6)");
    auto& approximate = out.claim("I_in/I_out, the equations alone, beside eq. 40", I_in / -at->at_rest("i(vout2)"))
                            .held_to(256, "thesis eq. 40; INVC, E.4");
    if (approximate.needs_reason()) approximate.because("eq. 40 takes S_C >> S_B + S_D; here it is 8 against 1");
    auto& card = out.claim("I_in/I_out, with the card", I_in / I).held_to(exact, "thesis eq. 38 and 39");
    if (card.needs_reason()) card.because(of_card);

    const double G_o = -at->by("i(vout)", "vout"), G_dd = -at->by("i(vout)", "vdd");
    const auto out_along = supplied->line("dc", "i(vout)").times(1, -1), C = supplied->line("dc", "i(vdd)").times(1, -1);
    out.claim("dI_out/dV_out, G_o", G_o, "S");
    out.claim("dI_out/dV_DD", G_dd, "S");
    out.claim("dI_out/dV_DD over G_o, in amount", std::abs(G_dd) / G_o);
    out.finds("A higher supply takes current from the output, for M_C's share grows", G_dd < 0, source);
    out.claim("I_out by a supply higher by 0.1 V", 100 * (out_along.at(supply + step) / out_along.at(supply) - 1), "%");
    auto& moved = out.claim("I_DC's change with it, over I_out", (C.at(supply + step) - C.at(supply)) / I)
                      .between(0.1, 10, source + ": \"can be in the same order of I_out magnitude\" (a tenth to ten times here)");
    if (moved.needs_reason())
        moved.because(
            fmt::format("M_C at fixed voltages would change by {:.2f} of I_out; but M_B nearly holds the sum, and the node between them "
                        "takes most of it back",
                        step * at->reading("mc", "g_md") / I));

    Plot by_supply{"What the supply does to the split current", "V_DD (V)", "over its value at 0.7 V", {}};
    by_supply.add("I_out", out_along.times(1, 1 / I)).add("I_DC", C.times(1, 1 / C.at(supply)));
    Plot transfer{"I_out of the splitting mirror", "I_in (nA)", "I_out (pA)", {}};
    transfer.add("with the card", along->line("dc", "i(vout)").times(1e9, -1e12));
    transfer.add(fmt::format("I_in/{:g}, eq. 38 and 39", exact), {{1, 1000}, {1e3 / exact, 1e6 / exact}})
        .add("I_in/256, eq. 40", {{1, 1000}, {1e3 / 256, 1e6 / 256}});
    out.plots = {by_supply.shape("C.2: I_out depends on V_DD by M_C's drain"), transfer.shape("C.2: N^4, here 256")};
    return out;
}

const Study study{"fig47", "The mirror that splits its current",
                  "Its attenuation, and what the supply does to it through M_C. Thesis C.2, fig. 47", work};

}  // namespace corpuscle::studies::fig47
