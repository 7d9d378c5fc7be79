// Equations 13 to 15, corrected by the errata, compared with the netlists; and the error of the printed forms (errata F1, F4, F5).
// Symbols. V_X is the sensor's voltage, which the amplifier holds at the reference V_Y. V_Z is the amplifier's output, I_F the transducer's
// output current, G_FSR (or G) the sensor's conductance, S_n the aspect ratio of M_n.

#include <fmt/format.h>
#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/force_sensor.hpp"

namespace corpuscle::studies::eq13_15 {

const ForceSensor sensor;

/// The largest relative difference (%) of a curve over the force (gf) from a formula of the force, from min_gf to max_gf.
template <class Formula>
double percent_difference(const StudyCurve& line, Formula formula) {
    double largest = 0;
    for (std::size_t k = 0; k < line.x.size(); ++k)
        if (line.x[k] >= min_gf && line.x[k] <= max_gf) largest = std::max(largest, std::abs(line.y[k] / formula(line.x[k]) - 1));
    return 100 * largest;
}

/// A curve of this netlist over the force, from 1 to 500 gf.
Result<StudyCurve> force_sweep(const std::string& circuit, const std::string& curve) {
    const auto found = run_study_netlist({circuit, {}, ".dc vgf 1 500 1"});
    if (!found) return found.error();
    return found->curve("dc", curve);
}

Result<StudyResult> compute(const StudyOptions&) {
    StudyResult out;
    const auto G = [](double gf) { return sensor.conductance(gf); };
    // Below, 0.1 V is V_Y, which V_X follows; 9.1 and 3.6 kohm are the netlist's R_F without and with a follower; G_0 is 1/R_0.
    const auto without_G0 = [](double gf) { return std::pow(gf, sensor.m) / sensor.a; };
    const auto ideal = force_sweep("force_to_voltage", "par('v(z)-v(x)')"),
               follower = force_sweep("force_to_voltage", "par('v(zb)-v(xb)')");
    const auto fig20_G = force_sweep("force_to_voltage", "par('(v(zb)-v(xb))/3.6k/v(xb)')"),
               fig21_G = force_sweep("force_to_current_plain", "par('i(vif)/v(vx)')");
    const auto fig21_I_F = force_sweep("force_to_current_plain", "i(vif)"),
               fig21_I_F_64x1 = force_sweep("force_to_current_plain", "i(vif4)");
    const auto V_X = force_sweep("transducer", "v(vx)"), I_F = force_sweep("transducer", "i(vif)");
    for (const auto* line : {&ideal, &follower, &fig20_G, &fig21_G, &fig21_I_F, &fig21_I_F_64x1, &V_X, &I_F})
        if (!*line) return line->error();
    const std::string bound = "; the bound is our choice", range = ", largest difference from 20 to 400 gf";

    out.claim("eq. 13: parallel resistances against the sum of conductances" + range,
              percent_difference(sensor.conductance_curve(1, 500),
                                 [](double gf) { return 1 / sensor.R_0 + 1 / (sensor.a * std::pow(gf, -sensor.m)); }),
              "%")
        .allow_max(1e-9, "thesis eq. 13: printed as approximate, but exact (errata F1a)");
    out.claim("eq. 13: G with a = 170 ohm over G with a = 170 kohm, at 400 gf", ForceSensor{.a = 170}.conductance(400) / G(400), "times")
        .derived_as(1, "thesis eq. 13")
        .explain_if_needed("a misprint for 170 kohm (errata F1)");
    out.claim("eq. 14, V_Z - V_X with an ideal amplifier" + range,
              percent_difference(*ideal, [&](double gf) { return 0.1 * G(gf) * 9.1e3; }), "%")
        .allow_max(1, "thesis eq. 14" + bound);
    out.claim("eq. 14, with fig. 23's amplifier and a follower" + range,
              percent_difference(*follower, [&](double gf) { return 0.1 * G(gf) * 3.6e3; }), "%")
        .allow_max(5, "thesis eq. 14" + bound);
    out.claim("eq. 14's last line omits G_0: error of V_Z - V_X at 20 gf", 100 * (1 - without_G0(20) / G(20)), "%")
        .allow_max(1, "printed as approximate (errata F5)" + bound);
    out.claim("eq. 14's last line with a F^m, a = 170: V_Z - V_X at 400 gf, R_F 9.1 kohm", 0.1 * 170 * std::pow(400, sensor.m) * 9.1e3, "V")
        .allow_max(0.7, "the supply")
        .explain_if_needed("a is printed where 1/a is meant, and is a thousand times too small (errata F1)");
    out.claim("eq. 15, (V_Z - V_X) / R_F over V_X, fig. 20 with a follower" + range, percent_difference(*fig20_G, G), "%")
        .allow_max(0.1, "thesis eq. 15" + bound);
    out.claim("eq. 15, I_F over V_X, fig. 21" + range, percent_difference(*fig21_G, G), "%").allow_max(0.1, "thesis eq. 15" + bound);
    out.claim("fig. 21 with M_1 16x1, I_F against V_Y G" + range, percent_difference(*fig21_I_F, [&](double gf) { return 0.1 * G(gf); }),
              "%")
        .allow_max(5, "V_X follows V_Y" + bound);
    out.claim("fig. 21 with M_1 64x1, I_F against V_Y G" + range,
              percent_difference(*fig21_I_F_64x1, [&](double gf) { return 0.1 * G(gf); }), "%")
        .allow_max(5, "V_X follows V_Y" + bound);
    out.claim("eq. 15 and the split of the current by 17, I_F against V_Y G / 17, fig. 22" + range,
              percent_difference(*I_F, [&](double gf) { return 0.1 * G(gf) / 17; }), "%")
        .allow_max(10, "thesis 4.2" + bound);
    out.claim("V_X against V_Y, fig. 22" + range, percent_difference(*V_X, [](double) { return 0.1; }), "%")
        .allow_max(5, "V_X follows V_Y" + bound);
    out.claim_true("the largest current is at the largest conductance", I_F->x_of_max() == 500 && G(500) > G(1),
                   "printed: at the smallest conductance (errata F4)");
    const auto percents = [](const StudyCurve& line, auto formula) {
        StudyCurve p = line.between(min_gf, max_gf);
        for (std::size_t k = 0; k < p.x.size(); ++k) p.y[k] = 100 * (p.y[k] / formula(p.x[k]) - 1);
        return p;
    };
    out.plot("Difference of the netlists from the equations, with V_Y for V_X", "force (gf)", "%")
        .add("eq. 14, ideal amplifier", percents(*ideal, [&](double gf) { return 0.1 * G(gf) * 9.1e3; }))
        .add("eq. 14, follower", percents(*follower, [&](double gf) { return 0.1 * G(gf) * 3.6e3; }))
        .add("eq. 15, fig. 21, 16x1", percents(*fig21_I_F, [&](double gf) { return 0.1 * G(gf); }))
        .add("eq. 15, fig. 21, 64x1", percents(*fig21_I_F_64x1, [&](double gf) { return 0.1 * G(gf); }))
        .add("eq. 15 / 17, fig. 22", percents(*I_F, [&](double gf) { return 0.1 * G(gf) / 17; }));
    out.note(
        "The error of fig. 22 is in the split: the single transistors of M_2 have the lower Early voltage and are connected to the supply, "
        "M_1 to the next mirror's diode.");
    return out;
}

const Study study{"eq13-15", "Equations 13 to 15 against the netlists",
                  "The sensor, the force-to-voltage gain and the sensor's current. Thesis 4.1 and 4.2, eq. 13 to 15", compute};

}  // namespace corpuscle::studies::eq13_15
