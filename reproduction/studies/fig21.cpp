// Fig. 21: force to current by one transistor with its bulk at vss. No size is published; this study shows the benefit of a larger
// transistor.
// Symbols. V_X is the sensor's voltage, which the amplifier holds at the reference V_Y. V_Z is the amplifier's output, I_F the transducer's
// output current, G_FSR (or G) the sensor's conductance, S_n the aspect ratio of M_n.

#include <fmt/format.h>
#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/force_sensor.hpp"

namespace corpuscle::studies::fig21 {

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    const std::string source = "thesis 4.2, fig. 21";
    const auto found = run_study_netlist({"force_to_current_plain", {}, ".dc vgf 1 500 1"});
    if (!found) return found.error();
    const auto I = found->curve("dc", "i(vif)"), I_64x1 = found->curve("dc", "i(vif4)"), V_X = found->curve("dc", "v(vx)");
    double worst_error = 0;
    for (double gf = min_gf; gf <= max_gf; ++gf)
        worst_error = std::max(worst_error, std::abs(I.at(gf) / (V_X.at(gf) * ForceSensor().conductance(gf)) - 1));
    out.claim("I_F against V_X G_FSR, largest difference from 20 to 400 gf", 100 * worst_error, "%")
        .allow_max(0.1, "thesis eq. 15; the bound is our choice");
    out.claim("V_X at 400 gf", V_X.at(400), "V").derived_as(0.1, source + ": \"to force V_X to follow V_Y\"");
    out.claim("I_F at 400 gf", I.at(400), "A").derived_as(0.1 * ForceSensor().conductance(400), "thesis eq. 15 at V_Y = 0.1 V");
    out.claim("dI_F/dF at 20 gf", I.slope_at(20), "A/gf").derived_as(0.1 * ForceSensor().slope(20), "thesis eq. 13 and 15");
    out.claim("V_BS of M_1 at 400 gf", -V_X.at(400), "V")
        .allow_max(0, source + ": \"V_BS = -V_X\", reverse biased (errata F7: its bulk is at vss)");

    const int columns[] = {8, 16, 32, 64, 128, 256, 512};
    std::vector<TransducerCell> cells;
    for (const int m : columns) cells.push_back({fmt::format("m{}", m), single_transistor_cell(m)});
    cells.push_back({"improved", improved_cell()});  // fig. 22; the last one
    const auto at_4N = run_study_netlist({transducer_netlist(cells, "4"), {}, ".op"});
    if (!at_4N) return at_4N.error();
    const auto lowest = find_lowest_supplies(cells, 4);
    if (!lowest) return lowest.error();
    if (auto ok = options.report_progress(0.8); !ok) return ok.error();
    StudyCurve V_Z, supply;  // V_Z at 0.7 V and the lowest supply, V, over the number of unit transistors
    for (std::size_t k = 0; k < std::size(columns); ++k) {
        V_Z.x.push_back(columns[k]), V_Z.y.push_back(at_4N->operating_point(fmt::format("v(x{}.vz)", cells[k].name)));
        supply.x.push_back(columns[k]), supply.y.push_back((*lowest)[k]);
    }
    out.claim("V_Z at 4 N with 16x1, at 0.7 V", V_Z.at(16), "V");
    out.claim("V_Z at 4 N with 256x1", V_Z.at(256), "V")
        .allow_max(V_Z.at(16), source + ": \"S_1 can be made large enough to allow a significantly low V_Z\"");
    out.claim("lowest supply at 4 N with 16x1", supply.at(16), "V");
    out.claim("lowest supply at 4 N with 256x1", supply.at(256), "V")
        .allow_max(supply.at(16), source + ": \"and consequently, a lower supply voltage\"");
    out.claim("number of unit transistors with which fig. 21 reaches the lowest supply of fig. 22, which has 40",
              supply.crossing(lowest->back()));
    out.claim("doubling S_1 at 256x1 lowers V_Z by", V_Z.at(256) - V_Z.at(512), "V");
    out.plot("21: I_F", "force (gf)", "uA")
        .add("16x1", I.scaled(1, 1e6))
        .add("64x1", I_64x1.scaled(1, 1e6))
        .describe_published("all of the sensor's current");
    StudyPlot& plot = out.plot("Benefit of a larger M_1 at 4 N", "unit transistors of M_1", "V");
    plot.log_x = true;
    plot.add("V_Z at 0.7 V", V_Z).add("lowest V_DD", supply);
    out.note("Lowest supply: V_X at least 95 % of V_Y, with the output at the supply. The study fig22 compares the three transducers.");
    return out;
}

const Study study{
    "fig21", "Force to current with one transistor",
    "One transistor carries the sensor's current; a larger one allows a lower V_Z and a lower supply. Thesis 4.2, fig. 21, eq. 15",
    compute};

}  // namespace corpuscle::studies::fig21
