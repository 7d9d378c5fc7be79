// The transconductors' bias generator, fig. 27, with the sizes of table 4, and with those of table 16, which gives the same circuit other
// sizes; and a check of its function.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/claims/study_netlist.hpp"

namespace corpuscle::studies::table4 {

constexpr double I_BIASB = 200e-9, V_DD = 0.7;  // A, V

/// The replica's current and the body voltage V_BN, for both sets of sizes.
Result<void> report_sizes(StudyResult& out) {
    // vi is I_BIASB, 1 V per uA
    const auto by_4 = run_study_netlist({"bias_table4", {}, ".dc vi 0.02 8 0.02"}), by_16 = run_study_netlist({"bias", {}, ".op"});
    if (!by_4) return by_4.error();
    if (!by_16) return by_16.error();
    const std::string reason =
        "with table 4's sizes the devices carry more than I_BIASB at half the supply without body bias, and the generator can only "
        "increase the current (errata I18)";
    for (const auto& [name, bn, replica] :
         {std::tuple{"table 4 as printed", "v(bn6)", "i(vis6)"}, {"table 4, N arrays of 1.5 um", "v(bn1)", "i(vis1)"}}) {
        const auto V_BN = by_4->curve("dc", bn), I_Q = by_4->curve("dc", replica);
        out.claim(fmt::format("{}: replica current at 200 nA", name), I_Q.at(0.2), "A")
            .derived_as(I_BIASB, "thesis E.2: I_Q is I_BIAS")
            .explain(reason);
        out.claim(fmt::format("{}: V_BN at 200 nA", name), V_BN.at(0.2), "V")
            .allow_range(100e-3, 600e-3, "thesis E.2: 100 to 600 mV over the generator's range")
            .explain(reason);
        out.claim(fmt::format("{}: I_BIASB from which V_BN is at least 100 mV", name), 1e-6 * V_BN.crossing(0.1), "A")
            .published_as(100e-9, "thesis E.2, fig. 53: the generator works from 100 nA")
            .explain(reason);
    }
    const auto q = by_16->operating_point("i(vis)");
    out.claim("table 16: replica current at 200 nA", q, "A").derived_as(I_BIASB, "thesis E.2: I_Q is I_BIAS");
    out.claim("table 16: V_BN at 200 nA", by_16->operating_point("v(bn)"), "V")
        .allow_range(100e-3, 600e-3, "thesis E.2: 100 to 600 mV over the generator's range");
    out.claim("table 16: V_REF", by_16->operating_point("v(ref)"), "V")
        .derived_as(V_DD / 2, "thesis 4.3.1, errata S12: half of V_DD, V_SS being 0");
    StudyPlot& p = out.plot("The replica's current over I_BIASB", "I_BIASB (nA)", "I_Q (nA)");
    p.add("table 4 as printed", by_4->curve("dc", "i(vis6)").between(0, 3).scaled(1e3, 1e9));
    p.add("table 4, N arrays of 1.5 um", by_4->curve("dc", "i(vis1)").between(0, 3).scaled(1e3, 1e9))
        .add("equal", {{20, 3000}, {20, 3000}});
    p.log_x = p.log_y = true;
    return {};
}

/// Resistance and current of the divider M1A, M1B, M2A, M2B: two stacked inverters with outputs tied to their inputs.
Result<void> report_divider(StudyResult& out) {
    const auto found = run_study_netlist({R"(The divider of two inverters
.lib '../process/tsmc180.lib' tt
vdd vdd 0 0.7
m1a top top vdd vdd pch w=6u l=0.5u m=2 stack=8
m2a top top ref ref nch w=1.5u l=0.5u m=2 stack=8
m1b low low ref ref pch w=6u l=0.5u m=2 stack=8
m2b low low 0   0   nch w=1.5u l=0.5u m=2 stack=8
vref ref 0 0.35
.op
.dc vref 0.34 0.36 1m
)"});
    if (!found) return found.error();
    const double R = 1 / std::abs(found->curve("dc", "i(vref)").slope_at(0.35)), I = std::abs(found->operating_point("i(vdd)"));
    out.claim("divider of M1 and M2: resistance at REF", R, "ohm")
        .allow_min(10 * 413e3, "thesis 4.3.1: very large resistances; ten times INVB's is our choice");
    out.claim("divider of M1 and M2: current", I, "A")
        .allow_max(0.1 * I_BIASB, "thesis 4.3.1: very large resistances; a tenth of I_BIASB is our choice");
    return {};
}

/// Finds the I_F1 at which V_F is half the supply in each corner; by the thesis it is I_BIASF.
Result<void> report_middle(StudyResult& out) {
    for (const char* corner : {"tt", "ss", "ff", "sf", "fs"}) {
        const auto found = run_study_netlist({"current_to_voltage", {fmt::format("corner={}", corner)}, ".dc if 1u 1.8u 10n"});
        if (!found) return found.error();
        out.claim(fmt::format("corner {}: I_F1, half of I_F, at which V_F is half the supply", corner),
                  found->curve("dc", "v(vf)").crossing(V_DD / 2) / 2, "A")
            .published_as(700e-9, "thesis 4.3.1: I_F1 = I_BIASF");
    }
    return {};
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    for (const auto add_part : {report_sizes, report_divider, report_middle}) {
        if (auto ok = add_part(out); !ok) return ok.error();
        if (auto ok = options.report_progress(0.5); !ok) return ok.error();
    }
    out.note("Subcircuits and chips are biased with table 16's sizes (circuits/bias.cir).");
    return out;
}

const Study study{"table4", "The transconductors' bias with table 4's sizes",
                  "V_REF, very large resistances, and V_F = V_DD/2 for I_F1 = I_BIASF. Thesis 4.3.1, fig. 27, table 4", compute};

}  // namespace corpuscle::studies::table4
