// Fig. 20: force to voltage. A transimpedance amplifier holds the sensor at V_Y and gives V_Z = V_X + V_FSR G_FSR R_F. No R_F is printed;
// circuits/force_to_voltage.cir chooses some.

#include <fmt/format.h>
#include <cmath>

#include "study/studies.hpp"
#include "study/thesis/force_sensor.hpp"

namespace corpuscle::studies::fig20 {

/// V_Z - V_X with an ideal amplifier, over the force in gf.
Result<Line> gain(std::vector<std::string> settings) {
    const auto found = found_in({"force_to_voltage", std::move(settings), ".dc vgf 1 500 1"});
    if (!found) return found.error();
    return found->line("dc", "par('v(z)-v(x)')");
}

/// Eq. 14 over the force in gf.
Line equation(double V, double R_F) { return ForceSensor().conductances(1, 500).times(1, V * R_F); }

double apart(const Line& a, const Line& b) {
    double most = 0;
    for (std::size_t k = 0; k < a.x.size(); ++k)
        if (a.x[k] >= least_gf && a.x[k] <= most_gf) most = std::max(most, std::abs(a.y[k] / b.at(a.x[k]) - 1));
    return most;
}

Result<Outcome> work(const StudyOptions& options) {
    Outcome out;
    const std::string source = "thesis 4.2, fig. 20", eq14 = "thesis eq. 14";
    const auto found = found_in({"force_to_voltage", {}, ".dc vgf 1 500 1"});
    if (!found) return found.error();
    const auto usual = gain({}), twice_V = gain({"vy=0.2"}), half_R = gain({"rf=4.55k"});
    for (const auto* g : {&usual, &twice_V, &half_R})
        if (!*g) return g->error();
    out.claim("ideal amplifier: V_Z - V_X against eq. 14, largest from 20 to 400 gf", 100 * apart(*usual, equation(0.1, 9.1e3)), "%")
        .at_most(1, eq14 + " (with the G_0 that its last line drops, errata F5); the bound is stated here");
    out.claim("V_Z - V_X at 400 gf with twice V_Y", twice_V->at(400) / usual->at(400), "times")
        .held_to(2, source + ": V_Y controls the gain");
    out.claim("V_Z - V_X at 400 gf with half R_F", half_R->at(400) / usual->at(400), "times")
        .held_to(0.5, source + ": R_F controls the gain");
    const auto G = ForceSensor().conductance(400);
    out.claim("current that the amplifier must give at 400 gf", 0.1 * G, "A");
    const auto i_a = found->line("dc", "par('(v(za)-v(xa))/9.1k')"), x_a = found->line("dc", "v(xa)");
    out.claim("fig. 23's amplifier gives, at 400 gf", i_a.at(400), "A")
        .at_least(0.95 * 0.1 * G, "thesis eq. 15: \"must be able to output\" it")
        .if_off("its output leg has I_BIASA of 100 nA and mirrors of one to one; it was made to drive gates (figs. 22, 23)");
    out.finds("so that with it alone \"the circuit will not function properly\": V_X at 20 gf is below half of V_Y", x_a.at(20) < 0.05,
              "thesis 4.2, below eq. 15");
    const auto z_b = found->line("dc", "v(zb)"), x_b = found->line("dc", "v(xb)");
    out.claim("with a follower (chosen): V_Z at 400 gf", z_b.at(400), "V")
        .held_to(0.1 + equation(0.1, 3.6e3).at(400), eq14 + " with 3.6 kohm");
    out.claim("with a follower: V_X at 400 gf", x_b.at(400), "V").held_to(0.1, source + ": \"forces V_X to follow V_Y\"");
    const auto z = found->line("dc", "v(z)");
    out.finds("V_Z and the current are largest at the largest force", z.peak() == 500 && z_b.peak() == 500,
              "thesis 4.2: \"for the maximum applied force\"");
    out.finds("there the conductance is largest, not least", ForceSensor().conductance(500) > ForceSensor().conductance(1),
              "printed: \"minimum ... conductance\", errata F4");
    if (auto ok = options.at(0.4); !ok) return ok.error();

    Line lowest;
    std::vector<TransducerCell> cells;
    for (const double R : {500.0, 1e3, 2e3, 3e3, 3.6e3, 5e3, 7e3, 9.1e3}) {
        cells.push_back({fmt::format("r{:g}", R), voltage_cell(R)});
        lowest.x.push_back(equation(0.1, R).at(400));
    }
    auto supplies = lowest_supplies(cells, 4);
    if (!supplies) return supplies.error();
    lowest.y = std::move(*supplies);
    out.claim("lowest supply at 4 N, a volt for each volt that V_Z rises by", lowest.straight().slope)
        .at_least(0.9, "thesis 4.2: V_Zmax \"limits the required minimum supply voltage\"; the bound is stated here");
    const auto amplifier = found_in({"amplifier"});
    if (!amplifier) return amplifier.error();
    out.claim("amplifiers of fig. 23 side by side that would hold the sensor to 5 % at 400 gf",
              0.1 * G / (0.05 * 0.1 * amplifier->number("g_m")));
    out.plot("20: V_Z", "force (gf)", "V")
        .add("eq. 14, 9.1 kohm", equation(0.1, 9.1e3).times(1, 1))
        .add("ideal amplifier, 9.1 kohm", z)
        .add("fig. 23's amplifier, 9.1 kohm", found->line("dc", "v(za)"))
        .add("with a follower, 3.6 kohm", z_b)
        .shape("V_Z proportional to the conductance");
    auto& eq = out.plots.back().series[0];
    for (double& v : eq.y) v += 0.1;
    out.plot("Lowest supply at 4 N over what V_Z rises by", "V_FSR G_FSR R_F at 400 gf (mV)", "lowest V_DD (mV)")
        .add("a follower of 64 units behind fig. 23's amplifier", lowest.times(1e3, 1e3));
    out.note("Lowest supply: V_X at least 95 % of V_Y. The three transducers stand side by side in fig22.");
    return out;
}

const Study study{
    "fig20", "Force to voltage",
    "A transimpedance amplifier holds the sensor at V_Y; what it gives is limited by its output. Thesis 4.2, fig. 20, eq. 14 and 15", work};

}  // namespace corpuscle::studies::fig20
