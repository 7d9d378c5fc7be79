// Fig. 19: the sensor, an FSR 400, by eq. 13 with the parameters of 4.1: its resistance (a) and its conductance (b) over force.

#include <fmt/format.h>
#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/force_sensor.hpp"

namespace corpuscle::studies::fig19 {

constexpr double from = 50, to = 4000;  // gf: the range in which the thesis calls the model fairly accurate

/// A quantity of the sensor from 10 gf to 10 kgf, 20 points in a decade.
StudyCurve sample_logarithmically(const ForceSensor& sensor, double (ForceSensor::*quantity)(double) const) {
    StudyCurve out;
    for (double gf = 10; gf <= 1e4; gf *= std::pow(10, 1.0 / 20)) out.x.push_back(gf), out.y.push_back((sensor.*quantity)(gf));
    return out;
}

/// Largest difference of a curve from its fitted straight line, as a fraction of its range.
double nonlinearity(const StudyCurve& line) { return line.fit_line().max_deviation / (line.max() - line.min()); }

/// The netlist's sensor at 1 V: its current (A), numerically equal to its conductance (S), over the force in gf.
Result<StudyCurve> simulate_sensor() {
    const auto found =
        run_study_netlist({"The sensor\n.lib '../process/tsmc180.lib' tt\n.include 'parts/transducer.inc'\n"
                           "vgf gf 0 20\neforce force 0 gf 0 9.80665m\nva a 0 1\nvi a b 0\nxfsr force b 0 fsr\n",
                           {},
                           ".dc vgf 20 4000 20"});
    if (!found) return found.error();
    return found->curve("dc", "i(vi)");
}

Result<StudyResult> compute(const StudyOptions&) {
    StudyResult out;
    const std::string source = "thesis 4.1", sheet = "FSR 400 series data sheet (Interlink)";
    const ForceSensor sensor, as_printed{.a = 170};
    const auto netlist = simulate_sensor();
    if (!netlist) return netlist.error();
    double worst_error = 0;
    for (std::size_t k = 0; k < netlist->x.size(); ++k)
        worst_error = std::max(worst_error, std::abs(netlist->y[k] / sensor.conductance(netlist->x[k]) - 1));
    out.claim("the netlist's sensor against eq. 13, largest difference", 100 * worst_error, "%")
        .allow_max(0.001, "the same formula; the bound is our choice");
    out.claim("resistance without force", sensor.resistance(0), "ohm").published_as(10e6, source + ": R_0; \"> 10 Mohms\" in the " + sheet);
    for (const double gf : {min_gf, from, 100.0, max_gf, 1000.0, to})
        out.claim(fmt::format("resistance at {:g} gf", gf), sensor.resistance(gf), "ohm");
    out.claim("with a = 170 ohm, as printed: resistance at 100 gf", as_printed.resistance(100), "ohm")
        .allow_min(100, "a sensor of some kilohms, by the " + sheet + "; the bound is our choice")
        .explain_if_needed("170 ohm is a misprint for 170 kohm (errata F1)");
    out.claim("with a as printed, and 170 times F^m as a conductance: resistance at 100 gf", 1 / (170 * std::pow(100, sensor.m)), "ohm")
        .allow_min(100, "a sensor of some kilohms, by the " + sheet + "; the bound is our choice")
        .explain_if_needed("a of eq. 13 is used as a conductance and has the unit of a resistance (errata F1)");
    const auto G = sensor.conductance_curve(min_gf, max_gf);
    StudyCurve R = G;
    for (double& v : R.y) v = 1 / v;
    out.claim("19b: nonlinearity of the conductance from 20 to 400 gf", 100 * nonlinearity(G), "%")
        .allow_max(10, source + ": \"almost linearly\"; the bound is our choice");
    out.claim("19b: slope at 20 gf over slope at 400 gf", sensor.slope(min_gf) / sensor.slope(max_gf), "times")
        .derived_as(1, source + ": \"as the slope factor m is close to unity\"")
        .explain_if_needed("m is 0.72, so the slope falls as F^-0.28 (errata F3)");
    out.claim("19a: nonlinearity of the resistance from 20 to 400 gf", 100 * nonlinearity(R), "%")
        .allow_min(10, source + ": \"highly non-linear\"; the bound is our choice");
    out.claim("smallest force of the press stimulus", 0.2 / gram_force, "gf")
        .allow_range(from, to, source + ": fairly accurate from 50 to 4000 g")
        .explain_if_needed("0.2 N lies below the range of the fit (errata F2)");
    out.claim("largest force of the press stimulus", 4 / gram_force, "gf")
        .allow_range(from, to, source + ": fairly accurate from 50 to 4000 g");
    out.claim("upper end of the fit as a force", to * gram_force, "N")
        .allow_max(20, sheet + ": 0.2 to 20 N")
        .explain_if_needed("4000 g exceeds the rating of the sensor (errata F2)");
    StudyPlot& a = out.plot("19a: resistance", "force (gf)", "ohm");
    a.log_x = a.log_y = true;
    a.add("eq. 13, a = 170 kohm", sample_logarithmically(sensor, &ForceSensor::resistance))
        .add("a = 170 ohm, as printed", sample_logarithmically(as_printed, &ForceSensor::resistance));
    a.describe_published("the supplier's typical curve, straight on two logarithmic axes, with the model on it");
    out.plot("19b: conductance", "force (gf)", "conductance (uS)")
        .add("eq. 13", sensor.conductance_curve(0, 1000, 5).scaled(1, 1e6))
        .add("netlist", netlist->between(20, 1000).scaled(1, 1e6), StudyPlot::Style::points)
        .describe_published("almost linear");
    out.note(
        "Whether the model is \"fairly accurate\" cannot be checked: the supplier's points are in the lost figure. It \"does not show "
        "hysteresis\" by assumption; the data sheet gives 10 % on average.");
    return out;
}

const Study study{"fig19", "The force-sensitive resistor",
                  "Resistance falls with force as a power law, conductance rises almost linearly. Thesis 4.1, fig. 19, eq. 13", compute};

}  // namespace corpuscle::studies::fig19
