// Fig. 22: force to current with the current split and the bulks lifted; what each of the two buys, and the three transducers side by side:
// the lowest supply at which each still holds its sensor at 4 N.

#include <fmt/format.h>
#include <cmath>

#include "study/studies.hpp"
#include "study/thesis/force_sensor.hpp"

namespace corpuscle::studies::fig22 {

const std::string source = "thesis 4.2, fig. 22";

struct Way {
    const char *name, *words;
    std::string lines;
};
std::vector<Way> ways() {
    return {{"voltage", "fig. 20 with a follower of 64 units, 3.6 kohm", voltage_cell(3.6e3)},
            {"plain", "fig. 21, M1 16x1", plain_cell(16)},
            {"plain40", "fig. 21, M1 of as many units as fig. 22 has", plain_cell(40)},
            {"atvss", "fig. 22 without M3, bulks at vss", improved_cell_at("0")},
            {"atsource", "fig. 22 without M3, bulks at the source", improved_cell_at("vx")},
            {"improved", "fig. 22", improved_cell()},
            {"read", "fig. 22, read by the diode of table 3", read_cell()}};
}

std::vector<TransducerCell> cells() {
    std::vector<TransducerCell> out;
    for (const auto& way : ways()) out.push_back({way.name, way.lines});
    return out;
}

/// What the two techniques do where all of them hold their sensor: 4 N, 0.9 V.
Result<void> tell_techniques(Outcome& out) {
    const auto found = found_in({transducers(cells(), "4"),
                                 {"vdd=0.9"},
                                 ".save i(ximproved.mn1) i(ximproved.mn2) i(ximproved.mn3) v(ximproved.tb) "
                                 "v(ximproved.vx) v(ximproved.vz) v(xatvss.vz) v(xplain.vz) v(xatsource.vz) "
                                 "i(xplain.vif) i(ximproved.vif)\n.op"});
    if (!found) return found.error();
    const auto at = [&](const std::string& name) { return found->at_rest(name); };
    out.claim("4 N, 0.9 V: I_D1 over I_D2", at("i(ximproved.mn1)") / at("i(ximproved.mn2)"))
        .held_to(1.0 / 16, source + ": S_1 / S_2")
        .if_off(
            "the single transistors of M_2 have the lower Early voltage and carry more than their share; at 0.7 V it is less so, their "
            "drain being "
            "lower");
    out.claim("I_F over fig. 21's", at("i(ximproved.vif)") / at("i(xplain.vif)"))
        .held_to(1.0 / 17, source + ": I_F = I_F0 S_1 / (S_1 + S_2), errata F8")
        .if_off("as above");
    out.claim("V_BS of M_1 and M_2 that M_3 makes", at("v(ximproved.tb)") - at("v(ximproved.vx)"), "V").at_least(0, source + ": forward");
    out.claim("current of M_3, through the bulks", at("i(ximproved.mn3)"), "A")
        .at_most(0.01 * at("i(ximproved.vif)"), "thesis app. D: M_3 limits it; a hundredth of I_F is stated here");
    out.claim("V_Z, fig. 22", at("v(ximproved.vz)"), "V");
    out.claim("V_Z without M_3, bulks at the source", at("v(xatsource.vz)"), "V");
    out.claim("V_Z without M_3, bulks at vss", at("v(xatvss.vz)"), "V")
        .at_least(at("v(ximproved.vz)"), source + ": forward bias decreases V_GS1 \"without increasing the transistor size\"");
    return {};
}

/// V_X over the supply, and where each begins to hold.
Result<void> tell_supplies(Outcome& out) {
    const auto found = found_in({transducers(cells(), "4"), {}, ".dc vdd 0.3 1 5m"});
    if (!found) return found.error();
    Plot plot{"V_X at 4 N along the supply", "V_DD (V)", "V_X (mV)", {}};
    std::map<std::string, double> lowest;
    for (const auto& way : ways()) {
        const auto V_X = found->line("dc", fmt::format("v(x{}.vx)", way.name));
        lowest[way.name] = V_X.where(0.95 * 0.1);
        plot.add(way.words, V_X.times(1, 1e3));
        out.claim(fmt::format("lowest supply at 4 N: {}", way.words), lowest[way.name], "V");
    }
    plot.add("holds: 95 % of V_Y", {{0.3, 1}, {95, 95}});
    out.claim("what M_3 saves of the supply, beside bulks at vss", lowest["atvss"] - lowest["improved"], "V").at_least(0, source);
    out.claim("beside bulks at the source", lowest["atsource"] - lowest["improved"], "V").at_least(0, source);
    out.claim("what the split and M_3 save, beside fig. 21 of as many units", lowest["plain40"] - lowest["improved"], "V")
        .at_least(0, source + ": lower \"without increasing the transistor size\"");
    out.claim("what fig. 22 saves beside fig. 20", lowest["voltage"] - lowest["improved"], "V")
        .at_least(0, "thesis 4.5: force to current \"allows lower supply voltage operation\"");
    const double I = 0.1 * ForceSensor().conductance(4 / gram_force) / 17;
    const auto I_F = found->line("dc", "i(xread.vif)");
    out.claim("read by table 3's diode: I_F within a tenth of eq. 15 / 17 from a supply of", I_F.where(0.9 * I), "V")
        .at_most(0.7, "thesis 4.2: works at 0.7 V; the tenth is stated here");
    out.plots.push_back(std::move(plot));
    return {};
}

Result<void> tell_forces_and_corners(Outcome& out, const StudyOptions& options) {
    const std::vector<TransducerCell> two = {{"lifted", improved_cell()}, {"atvss", improved_cell_at("0")}};
    Line lifted, at_vss;
    for (const double newtons : {0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 4.0, 6.0, 8.0}) {
        const auto lowest = lowest_supplies(two, newtons);
        if (!lowest) return lowest.error();
        lifted.x.push_back(newtons), lifted.y.push_back((*lowest)[0]);
        at_vss.x.push_back(newtons), at_vss.y.push_back((*lowest)[1]);
    }
    if (auto ok = options.at(0.7); !ok) return ok;
    Plot& plot = out.plot("Lowest supply along the force", "force (N)", "lowest V_DD (V)");
    plot.log_x = true;
    plot.add("fig. 22", lifted).add("without M3, bulks at vss", at_vss);
    for (const char* corner : {"ss", "ff", "sf", "fs"}) {
        const auto lowest = lowest_supplies(two, 4, {fmt::format("corner={}", corner)});
        if (!lowest) return lowest.error();
        out.claim(fmt::format("corner {}: lowest supply at 4 N, fig. 22", corner), (*lowest)[0], "V")
            .at_most(0.7, "thesis 4.2: works \"at worst case process corners\"");
        out.claim(fmt::format("corner {}: without M_3, bulks at vss", corner), (*lowest)[1], "V");
    }
    return {};
}

/// Which aspect ratios make which share of the current (errata F8).
Result<void> tell_split(Outcome& out) {
    Line made, meant;
    std::vector<TransducerCell> all;
    const int columns[] = {1, 2, 4, 8, 16};
    for (const int m : columns)
        all.push_back(
            {fmt::format("s{}", m), fmt::format("mn1 if vz vx tb nch w=1.5u l=0.5u m={} stack={}\nmn2 vdd vz vx tb nch w=1.5u l=0.5u m=16\n"
                                                "mn3 vz vdd tb tb nch w=1.5u l=0.5u m=8\n",
                                                m, 16 / m)});
    const auto found = found_in({transducers(all, "4"), {}, ".op"});
    if (!found) return found.error();
    for (const int m : columns) {
        const double S = m / (16.0 / m), I_F0 = 0.1 * ForceSensor().conductance(4 / gram_force);
        made.x.push_back(S / 16), made.y.push_back(1e6 * found->at_rest(fmt::format("i(xs{}.vif)", m)));
        meant.x.push_back(S / 16), meant.y.push_back(1e6 * I_F0 * S / (S + 16));
    }
    out.finds("the smaller S_1 / S_2, the smaller I_F", made.y.front() < made.y.back(), "printed: \"maximum S_1/S_2\", errata F8: minimum");
    Plot& plot = out.plot("I_F at 4 N by S_1 / S_2, sixteen units in M_1 each time", "S_1 / S_2", "I_F (uA)");
    plot.log_x = plot.log_y = true;
    plot.add("netlist", made, Plot::Style::points).add("I_F0 S_1 / (S_1 + S_2)", meant).shape("table 1 has 4x4 and 16x1: 1/16");
    return {};
}

Result<Outcome> work(const StudyOptions& options) {
    Outcome out;
    if (auto ok = tell_supplies(out); !ok) return ok.error();
    if (auto ok = tell_techniques(out); !ok) return ok.error();
    if (auto ok = options.at(0.4); !ok) return ok.error();
    if (auto ok = tell_forces_and_corners(out, options); !ok) return ok.error();
    if (auto ok = tell_split(out); !ok) return ok.error();
    out.note(
        "Lowest supply: V_X, which eq. 14 and 15 take for V_Y, is at least 95 % of it; what is read is held at the supply but for the last "
        "row. Fig. "
        "20's depends on its R_F (fig20), fig. 21's on its size (fig21); neither is printed.");
    out.note("M_3 is table 1's second M_1 (errata F9); its drain and bulk share are a reading: it lifts the bulks towards the supply.");
    return out;
}

const Study study{
    "fig22", "Force to current, improved, and the three transducers side by side",
    "The sensor's current is split by S_1 and S_2, and M_3 biases their bulks forward, so that V_GS and the supply can be lower. Thesis "
    "4.2, fig. 22, table 1; 4.5",
    work};

}  // namespace corpuscle::studies::fig22
