// Fig. 22: force to current with current splitting and forward-biased bulks, and the benefit of each. Compares the three transducers by the
// lowest supply at which they still regulate the sensor's voltage at 4 N.
// Symbols. V_X is the sensor's voltage, which the amplifier holds at the reference V_Y. V_Z is the amplifier's output, I_F the transducer's
// output current, G_FSR (or G) the sensor's conductance, S_n the aspect ratio of M_n.

#include <fmt/format.h>
#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/force_sensor.hpp"

namespace corpuscle::studies::fig22 {

const std::string source = "thesis 4.2, fig. 22";

/// A transducer: the name of its cell, its description in labels, its netlist lines.
struct Variant {
    const char *name, *description;
    std::string lines;
};
std::vector<Variant> variants() {
    return {{"voltage", "fig. 20 with a follower of 64 unit transistors, 3.6 kohm", voltage_cell(3.6e3)},
            {"plain", "fig. 21, M1 16x1", single_transistor_cell(16)},
            {"plain40", "fig. 21, M1 40x1, the number of unit transistors of fig. 22", single_transistor_cell(40)},
            {"atvss", "fig. 22 without M3, bulks at vss", improved_cell_with_bulks("0")},
            {"atsource", "fig. 22 without M3, bulks at the source", improved_cell_with_bulks("vx")},
            {"improved", "fig. 22", improved_cell()},
            {"read", "fig. 22, loaded by the diode of table 3", improved_cell_with_diode()}};
}

std::vector<TransducerCell> cells() {
    std::vector<TransducerCell> out;
    for (const auto& variant : variants()) out.push_back({variant.name, variant.lines});
    return out;
}

/// Effect of current splitting and of forward-biased bulks at 4 N and 0.9 V, where all transducers regulate the sensor's voltage.
Result<void> report_techniques(StudyResult& out) {
    const auto found = run_study_netlist({transducer_netlist(cells(), "4"),
                                          {"vdd=0.9"},
                                          ".save i(ximproved.mn1) i(ximproved.mn2) i(ximproved.mn3) v(ximproved.tb) "
                                          "v(ximproved.vx) v(ximproved.vz) v(xatvss.vz) v(xplain.vz) v(xatsource.vz) "
                                          "i(xplain.vif) i(ximproved.vif)\n.op"});
    if (!found) return found.error();
    const auto at = [&](const std::string& name) { return found->operating_point(name); };
    out.claim("4 N, 0.9 V: I_D1 over I_D2", at("i(ximproved.mn1)") / at("i(ximproved.mn2)"))
        .derived_as(1.0 / 16, source + ": S_1 / S_2")
        .explain_if_needed(
            "the single transistors of M_2 have the lower Early voltage and carry more current than their ratio gives; the effect is "
            "smaller at 0.7 V, where their drain is lower");
    out.claim("4 N, 0.9 V: I_F of fig. 22 over I_F of fig. 21", at("i(ximproved.vif)") / at("i(xplain.vif)"))
        .derived_as(1.0 / 17, source + ": I_F = I_F0 S_1 / (S_1 + S_2), errata F8")
        .explain_if_needed("the single transistors of M_2 carry more current than their ratio gives");
    out.claim("4 N, 0.9 V: V_BS of M_1 and M_2, set by M_3", at("v(ximproved.tb)") - at("v(ximproved.vx)"), "V")
        .allow_min(0, source + ": forward");
    out.claim("4 N, 0.9 V: current of M_3, which flows through the bulks", at("i(ximproved.mn3)"), "A")
        .allow_max(0.01 * at("i(ximproved.vif)"), "thesis app. D: M_3 limits it; a hundredth of I_F is our choice");
    out.claim("4 N, 0.9 V: V_Z, fig. 22", at("v(ximproved.vz)"), "V");
    out.claim("4 N, 0.9 V: V_Z without M_3, bulks at the source", at("v(xatsource.vz)"), "V");
    out.claim("4 N, 0.9 V: V_Z without M_3, bulks at vss", at("v(xatvss.vz)"), "V")
        .allow_min(at("v(ximproved.vz)"), source + ": forward bias decreases V_GS1 \"without increasing the transistor size\"");
    return {};
}

/// V_X over the supply, and the lowest supply of each transducer.
Result<void> report_supplies(StudyResult& out) {
    const auto found = run_study_netlist({transducer_netlist(cells(), "4"), {}, ".dc vdd 0.3 1 5m"});
    if (!found) return found.error();
    StudyPlot plot{"V_X at 4 N over the supply", "V_DD (V)", "V_X (mV)", {}};
    std::map<std::string, double> lowest;
    for (const auto& variant : variants()) {
        const auto V_X = found->curve("dc", fmt::format("v(x{}.vx)", variant.name));
        lowest[variant.name] = V_X.crossing(0.95 * 0.1);
        plot.add(variant.description, V_X.scaled(1, 1e3));
        out.claim(fmt::format("lowest supply at 4 N: {}", variant.description), lowest[variant.name], "V");
    }
    plot.add("limit: 95 % of V_Y", {{0.3, 1}, {95, 95}});
    out.claim("supply saved by M_3, compared with bulks at vss", lowest["atvss"] - lowest["improved"], "V").allow_min(0, source);
    out.claim("supply saved by M_3, compared with bulks at the source", lowest["atsource"] - lowest["improved"], "V").allow_min(0, source);
    out.claim("supply saved by the split and M_3, compared with fig. 21 with the same number of unit transistors",
              lowest["plain40"] - lowest["improved"], "V")
        .allow_min(0, source + ": lower \"without increasing the transistor size\"");
    out.claim("supply saved by fig. 22, compared with fig. 20", lowest["voltage"] - lowest["improved"], "V")
        .allow_min(0, "thesis 4.5: force to current \"allows lower supply voltage operation\"");
    const double I = 0.1 * ForceSensor().conductance(4 / gram_force) / 17;
    const auto I_F = found->curve("dc", "i(xread.vif)");
    out.claim("loaded by table 3's diode: I_F within a tenth of eq. 15 / 17 from a supply of", I_F.crossing(0.9 * I), "V")
        .allow_max(0.7, "thesis 4.2: works at 0.7 V; the tenth is our choice");
    out.plots.push_back(std::move(plot));
    return {};
}

/// The lowest supply over the force, and in the process corners, with and without the forward-biased bulks.
Result<void> report_forces_and_corners(StudyResult& out, const StudyOptions& options) {
    const std::vector<TransducerCell> two_cells = {{"lifted", improved_cell()}, {"atvss", improved_cell_with_bulks("0")}};
    StudyCurve lifted, at_vss;  // lowest supply (V) over the force (N), with and without the forward-biased bulks
    for (const double newtons : {0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 4.0, 6.0, 8.0}) {
        const auto lowest = find_lowest_supplies(two_cells, newtons);
        if (!lowest) return lowest.error();
        lifted.x.push_back(newtons), lifted.y.push_back((*lowest)[0]);
        at_vss.x.push_back(newtons), at_vss.y.push_back((*lowest)[1]);
    }
    if (auto ok = options.report_progress(0.7); !ok) return ok;
    StudyPlot& plot = out.plot("Lowest supply over the force", "force (N)", "lowest V_DD (V)");
    plot.log_x = true;
    plot.add("fig. 22", lifted).add("without M3, bulks at vss", at_vss);
    for (const char* corner : {"ss", "ff", "sf", "fs"}) {
        const auto lowest = find_lowest_supplies(two_cells, 4, {fmt::format("corner={}", corner)});
        if (!lowest) return lowest.error();
        out.claim(fmt::format("corner {}: lowest supply at 4 N, fig. 22", corner), (*lowest)[0], "V")
            .allow_max(0.7, "thesis 4.2: works \"at worst case process corners\"");
        out.claim(fmt::format("corner {}: lowest supply at 4 N, fig. 22 without M_3, bulks at vss", corner), (*lowest)[1], "V");
    }
    return {};
}

/// I_F over S_1 / S_2, the ratio of the aspect ratios (errata F8).
Result<void> report_split(StudyResult& out) {
    StudyCurve simulated, expected;  // I_F (uA) over S_1 / S_2
    std::vector<TransducerCell> all;
    const int columns[] = {1, 2, 4, 8, 16};
    for (const int m : columns)
        all.push_back(
            {fmt::format("s{}", m), fmt::format("mn1 if vz vx tb nch w=1.5u l=0.5u m={} stack={}\nmn2 vdd vz vx tb nch w=1.5u l=0.5u m=16\n"
                                                "mn3 vz vdd tb tb nch w=1.5u l=0.5u m=8\n",
                                                m, 16 / m)});
    const auto found = run_study_netlist({transducer_netlist(all, "4"), {}, ".op"});
    if (!found) return found.error();
    for (const int m : columns) {
        const double S = m / (16.0 / m), I_F0 = 0.1 * ForceSensor().conductance(4 / gram_force);
        simulated.x.push_back(S / 16), simulated.y.push_back(1e6 * found->operating_point(fmt::format("i(xs{}.vif)", m)));
        expected.x.push_back(S / 16), expected.y.push_back(1e6 * I_F0 * S / (S + 16));
    }
    out.claim_true("a smaller S_1 / S_2 gives a smaller I_F", simulated.y.front() < simulated.y.back(),
                   "printed: \"maximum S_1/S_2\"; by errata F8 the minimum is meant");
    StudyPlot& plot = out.plot("I_F at 4 N over S_1 / S_2, with sixteen unit transistors in each M_1", "S_1 / S_2", "I_F (uA)");
    plot.log_x = plot.log_y = true;
    plot.add("netlist", simulated, StudyPlot::Style::points)
        .add("I_F0 S_1 / (S_1 + S_2)", expected)
        .describe_published("table 1 has 4x4 and 16x1: 1/16");
    return {};
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    if (auto ok = report_supplies(out); !ok) return ok.error();
    if (auto ok = report_techniques(out); !ok) return ok.error();
    if (auto ok = options.report_progress(0.4); !ok) return ok.error();
    if (auto ok = report_forces_and_corners(out, options); !ok) return ok.error();
    if (auto ok = report_split(out); !ok) return ok.error();
    out.note(
        "Lowest supply: V_X, which eq. 14 and 15 set equal to V_Y, is at least 95 % of V_Y. The output is held at the supply, except "
        "where it is loaded by the diode of table 3. The result for fig. 20 depends on R_F (fig20), that for fig. 21 on the size (fig21); "
        "neither is published.");
    out.note(
        "M_3 is table 1's second M_1 (errata F9). Its drain and bulk connections are our interpretation: it lifts the bulks towards the "
        "supply.");
    return out;
}

const Study study{"fig22", "Force to current, improved, and comparison of the three transducers",
                  "The sensor's current is split by S_1 and S_2, and M_3 forward-biases their bulks, which allows a lower V_GS and supply. "
                  "Thesis 4.2, fig. 22, table 1; 4.5",
                  compute};

}  // namespace corpuscle::studies::fig22
