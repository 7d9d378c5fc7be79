// Fig. 20: force to voltage. A transimpedance amplifier holds the sensor's voltage V_X at V_Y, so V_FSR, across the sensor, is V_Y. Its
// output is V_Z = V_X + V_FSR G_FSR R_F. R_F is not published; circuits/force_to_voltage.cir chooses values.

#include <fmt/format.h>
#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/force_sensor.hpp"

namespace corpuscle::studies::fig20 {

/// V_Z - V_X with an ideal amplifier, over the force in gf.
Result<StudyCurve> ideal_output(std::vector<std::string> settings) {
    const auto found = run_study_netlist({"force_to_voltage", std::move(settings), ".dc vgf 1 500 1"});
    if (!found) return found.error();
    return found->curve("dc", "par('v(z)-v(x)')");
}

/// V_Z - V_X (V) by eq. 14 over the force in gf, for a sensor voltage V (V) and R_F (ohm).
StudyCurve equation(double V, double R_F) { return ForceSensor().conductance_curve(1, 500).scaled(1, V * R_F); }

/// Largest relative difference (a fraction) of a from b, from min_gf to max_gf.
double worst_error(const StudyCurve& a, const StudyCurve& b) {
    double worst = 0;
    for (std::size_t k = 0; k < a.x.size(); ++k)
        if (a.x[k] >= min_gf && a.x[k] <= max_gf) worst = std::max(worst, std::abs(a.y[k] / b.at(a.x[k]) - 1));
    return worst;
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    const std::string source = "thesis 4.2, fig. 20", eq14 = "thesis eq. 14";
    const auto found = run_study_netlist({"force_to_voltage", {}, ".dc vgf 1 500 1"});
    if (!found) return found.error();
    const auto nominal = ideal_output({}), twice_V = ideal_output({"vy=0.2"}), half_R = ideal_output({"rf=4.55k"});
    for (const auto* g : {&nominal, &twice_V, &half_R})
        if (!*g) return g->error();
    out.claim("ideal amplifier: V_Z - V_X against eq. 14, largest difference from 20 to 400 gf",
              100 * worst_error(*nominal, equation(0.1, 9.1e3)), "%")
        .allow_max(1, eq14 + " (with the G_0 that its last line drops, errata F5); the bound is our choice");
    out.claim("V_Z - V_X at 400 gf: with twice V_Y over that with V_Y", twice_V->at(400) / nominal->at(400), "times")
        .derived_as(2, source + ": V_Y controls the gain");
    out.claim("V_Z - V_X at 400 gf: with half of R_F over that with R_F", half_R->at(400) / nominal->at(400), "times")
        .derived_as(0.5, source + ": R_F controls the gain");
    const auto G = ForceSensor().conductance(400);
    out.claim("output current that the amplifier needs at 400 gf", 0.1 * G, "A");
    // nodes: za, xa with fig. 23's amplifier; zb, xb with this amplifier and a follower; z, x with an ideal amplifier
    const auto i_a = found->curve("dc", "par('(v(za)-v(xa))/9.1k')"), x_a = found->curve("dc", "v(xa)");
    out.claim("output current of fig. 23's amplifier at 400 gf", i_a.at(400), "A")
        .allow_min(0.95 * 0.1 * G, "thesis eq. 15: \"must be able to output\" it")
        .explain_if_needed(
            "the amplifier's output branch has I_BIASA of 100 nA and mirrors of one to one; it was designed to drive gates (figs. 22, 23)");
    out.claim_true("with this amplifier only, \"the circuit will not function properly\": V_X at 20 gf is below half of V_Y",
                   x_a.at(20) < 0.05, "thesis 4.2, below eq. 15");
    const auto z_b = found->curve("dc", "v(zb)"), x_b = found->curve("dc", "v(xb)");
    out.claim("with a follower (our choice): V_Z at 400 gf", z_b.at(400), "V")
        .derived_as(0.1 + equation(0.1, 3.6e3).at(400), eq14 + " with 3.6 kohm");
    out.claim("with a follower: V_X at 400 gf", x_b.at(400), "V").derived_as(0.1, source + ": \"forces V_X to follow V_Y\"");
    const auto z = found->curve("dc", "v(z)");
    out.claim_true("V_Z is largest at the largest force, with the ideal amplifier and with the follower",
                   z.x_of_max() == 500 && z_b.x_of_max() == 500, "thesis 4.2: \"for the maximum applied force\"");
    out.claim_true("at the largest force the conductance is largest, not smallest",
                   ForceSensor().conductance(500) > ForceSensor().conductance(1), "printed: \"minimum ... conductance\", errata F4");
    if (auto ok = options.report_progress(0.4); !ok) return ok.error();

    StudyCurve lowest;  // lowest supply (V) over V_FSR G_FSR R_F at 400 gf (V), for several R_F
    std::vector<TransducerCell> cells;
    for (const double R : {500.0, 1e3, 2e3, 3e3, 3.6e3, 5e3, 7e3, 9.1e3}) {
        cells.push_back({fmt::format("r{:g}", R), voltage_cell(R)});
        lowest.x.push_back(equation(0.1, R).at(400));
    }
    auto supplies = find_lowest_supplies(cells, 4);
    if (!supplies) return supplies.error();
    lowest.y = std::move(*supplies);
    out.claim("rise of the lowest supply at 4 N over the rise of V_Z", lowest.fit_line().slope)
        .allow_min(0.9, "thesis 4.2: V_Zmax \"limits the required minimum supply voltage\"; the bound is our choice");
    const auto amplifier = run_study_netlist({"amplifier"});
    if (!amplifier) return amplifier.error();
    out.claim("number of parallel amplifiers of fig. 23 that would hold V_X within 5 % of V_Y at 400 gf",
              0.1 * G / (0.05 * 0.1 * amplifier->number("g_m")));
    out.plot("20: V_Z", "force (gf)", "V")
        .add("eq. 14, 9.1 kohm", equation(0.1, 9.1e3).scaled(1, 1))
        .add("ideal amplifier, 9.1 kohm", z)
        .add("fig. 23's amplifier, 9.1 kohm", found->curve("dc", "v(za)"))
        .add("with a follower, 3.6 kohm", z_b)
        .describe_published("V_Z proportional to the conductance");
    auto& V_Z_by_14 = out.plots.back().series[0];  // eq. 14 gives V_Z - V_X; V_X is 0.1 V
    for (double& v : V_Z_by_14.y) v += 0.1;
    out.plot("Lowest supply at 4 N over the rise of V_Z", "V_FSR G_FSR R_F at 400 gf (mV)", "lowest V_DD (mV)")
        .add("follower of 64 unit transistors behind fig. 23's amplifier", lowest.scaled(1e3, 1e3));
    out.note("Lowest supply: V_X at least 95 % of V_Y. The study fig22 compares the three transducers.");
    return out;
}

const Study study{"fig20", "Force to voltage",
                  "A transimpedance amplifier holds the sensor at V_Y; its output current limits it. Thesis 4.2, fig. 20, eq. 14 and 15",
                  compute};

}  // namespace corpuscle::studies::fig20
