// Fig. 47: the current-splitting mirror with 8x1 and 2x4 arrays, as in INVC and the summer, and the effect of the supply on its output.

#include <fmt/format.h>
#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/claims/study_netlist.hpp"

namespace corpuscle::studies::fig47 {

constexpr double I_in = 100e-9, supply = 0.7, step = 0.1;  // A, V, V; step: a change of the supply
constexpr double S_A = 8, S_B = 0.5, S_C = 8, S_D = 0.5;   // aspect ratios of M_A to M_D (8x1 or 2x4), relative to a unit transistor's

Result<StudyResult> compute(const StudyOptions&) {
    const auto nominal = run_study_netlist({"split_mirror", {}, ".op\n.tf i(vout) vout\n.tf i(vout) vdd"});
    const auto over_supply = run_study_netlist({"split_mirror", {"iin2=0"}, ".dc vdd 0.4 1.2 5m"});  // iin2=0: vdd then supplies M_C only
    const auto over_input = run_study_netlist({"split_mirror", {}, ".dc iin 1n 1u 1n"});
    if (!nominal || !over_input || !over_supply) return !nominal ? nominal.error() : !over_input ? over_input.error() : over_supply.error();
    StudyResult out;
    const std::string
        source = "thesis C.2",
        length_modulation =
            "the parallel diodes have a larger drain-source voltage than the series arrays, and length modulation increases their current";
    const double I = -nominal->operating_point("i(vout)"), exact = S_A * (S_B + S_C + S_D) / (S_B * S_D);
    out.claim("I_in/I_out, equations only", I_in / -nominal->operating_point("i(vout2)"))
        .derived_as(exact, "thesis eq. 38 and 39, exact (errata C5, C6)");
    auto& approximate = out.claim("I_in/I_out, equations only, against eq. 40", I_in / -nominal->operating_point("i(vout2)"))
                            .derived_as(256, "thesis eq. 40; INVC, E.4");
    if (approximate.needs_explanation()) approximate.explain("eq. 40 assumes S_C >> S_B + S_D; here S_C is 8 and S_B + S_D is 1");
    auto& with_card = out.claim("I_in/I_out, with the process card", I_in / I).derived_as(exact, "thesis eq. 38 and 39");
    if (with_card.needs_explanation()) with_card.explain(length_modulation);

    const double G_o = -nominal->derivative("i(vout)", "vout"), G_dd = -nominal->derivative("i(vout)", "vdd");
    const auto out_over_supply = over_supply->curve("dc", "i(vout)").scaled(1, -1), I_DC = over_supply->curve("dc", "i(vdd)").scaled(1, -1);
    out.claim("dI_out/dV_out, G_o", G_o, "S");
    out.claim("dI_out/dV_DD", G_dd, "S");
    out.claim("magnitude of dI_out/dV_DD over G_o", std::abs(G_dd) / G_o);
    out.claim_true("a higher supply reduces the output current, because M_C takes a larger fraction", G_dd < 0, source);
    out.claim("change of I_out for a supply higher by 0.1 V", 100 * (out_over_supply.at(supply + step) / out_over_supply.at(supply) - 1),
              "%");
    auto& supply_effect =
        out.claim("change of I_DC for a supply higher by 0.1 V, over I_out", (I_DC.at(supply + step) - I_DC.at(supply)) / I)
            .allow_range(0.1, 10, source + ": \"can be in the same order of I_out magnitude\" (a tenth to ten times here)");
    if (supply_effect.needs_explanation())
        supply_effect.explain(
            fmt::format("M_C at fixed voltages would change by {:.2f} of I_out; but M_B keeps the sum almost constant, and the node "
                        "between them compensates most of the change",
                        step * nominal->operating_info("mc", "g_md") / I));

    StudyPlot by_supply{"Effect of the supply on the split current", "V_DD (V)", "over its value at 0.7 V", {}};
    by_supply.add("I_out", out_over_supply.scaled(1, 1 / I)).add("I_DC", I_DC.scaled(1, 1 / I_DC.at(supply)));
    StudyPlot transfer{"I_out of the current-splitting mirror", "I_in (nA)", "I_out (pA)", {}};
    transfer.add("with the process card", over_input->curve("dc", "i(vout)").scaled(1e9, -1e12));
    transfer.add(fmt::format("I_in/{:g}, eq. 38 and 39", exact), {{1, 1000}, {1e3 / exact, 1e6 / exact}})
        .add("I_in/256, eq. 40", {{1, 1000}, {1e3 / 256, 1e6 / 256}});
    out.plots = {by_supply.describe_published("C.2: I_out depends on V_DD through M_C's drain"),
                 transfer.describe_published("C.2: N^4, here 256")};
    return out;
}

const Study study{"fig47", "The current-splitting mirror",
                  "Its attenuation, and the effect of the supply on it through M_C. Thesis C.2, fig. 47", compute};

}  // namespace corpuscle::studies::fig47
