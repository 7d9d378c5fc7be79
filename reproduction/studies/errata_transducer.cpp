// Errors and open points of the thesis's 4.1 and 4.2 that a computation can show: the printed form compared with our circuit, which follows
// the errata F1 to F12. Of these, F6, F10 and F11 change no number.
// Symbols. V_X is the sensor's voltage, which the amplifier holds at the reference V_Y. V_Z is the amplifier's output, I_F the transducer's
// output current, G_FSR (or G) the sensor's conductance, S_n the aspect ratio of M_n.

#include <fmt/format.h>
#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/force_sensor.hpp"

namespace corpuscle::studies::errata_transducer {

const ForceSensor sensor;

/// F1 to F5: the sensor and its equations.
void report_sensor(StudyResult& out) {
    const double press = 4 / gram_force;  // gf, the largest force of the press stimulus
    out.claim("F1: sensor current at 4 N and 0.1 V, a = 170 kohm", 0.1 * sensor.conductance(press), "A");
    out.claim("F1: sensor current at 4 N and 0.1 V, a = 170 ohm as printed", 0.1 * ForceSensor{.a = 170}.conductance(press), "A")
        .allow_max(1e-3, "thesis 4.2: I_F is 1/17 of it and drives a mirror of 100 nA unit transistors; a milliampere is our choice")
        .explain_if_needed("a misprint for 170 kohm");
    out.claim("F1: sensor current at 4 N and 0.1 V, a = 170 as a conductance (a F^m)", 0.1 * 170 * std::pow(press, sensor.m), "A")
        .allow_max(1e-3, "thesis 4.2: I_F is 1/17 of it and drives a mirror of 100 nA unit transistors; a milliampere is our choice")
        .explain_if_needed("a is a resistance, used where a conductance is meant");
    out.claim("F2: smallest force of the press stimulus; the fit is stated to be fair from 50 gf on", 0.2 / gram_force, "gf")
        .allow_min(50, "thesis 4.1")
        .explain_if_needed("the press stimulus begins below 50 gf, and so does fig. 24, at 20 gf");
    out.claim("F3: dI_F/dF at 20 gf over that at 400 gf, by m = 0.72", sensor.slope(20) / sensor.slope(400), "times")
        .derived_as(12.0 / 4, "thesis 4.2, fig. 24b")
        .explain_if_needed("eq. 13 gives (400/20)^0.28; both published numbers are \"approximately\"");
    out.claim("F3: m that would give fig. 24b's slopes", 1 - std::log(12.0 / 4) / std::log(400.0 / 20))
        .published_as(sensor.m, "thesis 4.1")
        .explain_if_needed("12 and 4 are round numbers from a figure");
    out.claim_true("F4: the largest force gives the smallest conductance", sensor.conductance(press) < sensor.conductance(0.2 / gram_force),
                   "thesis 4.2, as printed")
        .explain_if_needed("the largest force gives the largest conductance: resistance falls with force");
    out.claim("F5: G_0, which eq. 14's last line omits, over G at 20 gf", 100 / sensor.R_0 / sensor.conductance(20), "%")
        .allow_max(1, "printed as approximate; the bound is our choice");
}

/// F7 to F9: the transistors of figs. 21 and 22.
Result<void> report_transistors(StudyResult& out) {
    const std::string swapped =
        "mn1 if vz vx tb nch w=1.5u l=0.5u m=16\nmn2 vdd vz vx tb nch w=1.5u l=0.5u m=4 stack=4\nmn3 vz vdd tb tb nch w=1.5u l=0.5u m=8\n";
    const std::string bulk_at_vss = improved_cell_with_bulks("0");
    const TransducerCell cells[] = {
        {"built", improved_cell()}, {"swapped", swapped}, {"without", bulk_at_vss}, {"plain", single_transistor_cell(16)}};
    const auto found = run_study_netlist({transducer_netlist(cells, "4"), {}, ".op"});
    if (!found) return found.error();
    // I_F of a cell over I_F0, the sensor's current at this V_X
    const auto current = [&](const char* name) {
        return found->operating_point(fmt::format("i(x{}.vif)", name)) /
               (found->operating_point(fmt::format("v(x{}.vx)", name)) * sensor.conductance(4 / gram_force));
    };
    out.claim("F7: V_BS of fig. 21's M_1 with its bulk at vss", -found->operating_point("v(xplain.vx)"), "V")
        .derived_as(-0.1, "thesis 4.2: V_BS = -V_X, at V_Y = 0.1 V; it is the bulk that is at vss");
    out.claim("F8: I_F over I_F0 with S_1 = 4/4, S_2 = 16", current("built")).derived_as(1.0 / 17, "S_1 / (S_1 + S_2) by table 1");
    out.claim("F8: I_F over I_F0 with S_1 = 4/4, S_2 = 16, against S_1 / S_2 as printed", current("built"))
        .derived_as(1.0 / 16, "thesis 4.2: I_F = (S_1/S_2) I_D2, taken as the fraction of I_F0")
        .explain_if_needed("S_1 / S_2 is I_F over I_D2, not over I_F0, and M_2's single transistors take a little more");
    out.claim("F8: I_F over I_F0 with the \"maximum\" S_1 / S_2 (16x1 and 4x4)", current("swapped"))
        .allow_max(0.5, "thesis 4.2: the aim is a smaller I_F; a half is our choice")
        .explain_if_needed("the minimum is meant");
    out.claim("F9: V_X at 4 N and 0.7 V with 8x1 as M_3", found->operating_point("v(xbuilt.vx)"), "V")
        .derived_as(0.1, "thesis 4.2, fig. 24c: V_X follows V_Y");
    out.claim("F9: V_X without M_3, bulks at vss", found->operating_point("v(xwithout.vx)"), "V").derived_as(0.1, "thesis 4.2, fig. 24c");
    out.claim("F9: V_Z without M_3", found->operating_point("v(xwithout.vz)"), "V")
        .allow_max(0.525, "thesis 4.2, fig. 24c: V_Z at most V_DD - 175 mV")
        .explain_if_needed("without body bias the gate voltages must be higher: the second M_1 of table 1 is M_3");
    return {};
}

/// F10a: can the amplifier's input pair (M3) be NMOS, or have the width of table 2, 1.5 um?
Result<void> report_pair(StudyResult& out) {
    const auto found = run_study_netlist({R"(Current of a transistor of table 2's M3 with its gate at V_Y
.lib '../process/tsmc180.lib' tt
vg g 0 0.1
vd d 0 0.35
vb b 0 0.4
va d da 0
mna da g 0 0 nch w=1.5u l=0.5u m=16
vc d db 0
mnb db g 0 b nch w=1.5u l=0.5u m=16
)",
                                          {},
                                          ".op"});
    if (!found) return found.error();
    const std::string needs = "half of the tail's 200 nA (table 2, I_BIASA 100 nA)",
                      reason = "not possible: the gate is far below the threshold even with the source at vss";
    out.claim("F10a: current of an N transistor 16x1 at V_G = 0.1 V, its source at vss", found->operating_point("i(va)"), "A")
        .allow_min(100e-9, needs)
        .explain_if_needed(reason);
    out.claim("F10a: current of an N transistor 16x1 at V_G = 0.1 V, its bulk at 0.4 V", found->operating_point("i(vc)"), "A")
        .allow_min(100e-9, needs)
        .explain_if_needed(reason);
    const auto narrow =
        substitute_in_embedded_text("circuits/parts/transducer.inc", {{"mp3a f1 plus  t b3 pch w=6u", "mp3a f1 plus  t b3 pch w=1.5u"},
                                                                      {"mp3b f2 minus t b4 pch w=6u", "mp3b f2 minus t b4 pch w=1.5u"}});
    const auto usual = substitute_in_embedded_text("circuits/parts/transducer.inc", {});
    for (const auto& [description, parts] : {std::pair{"a P pair of 6 um", &usual}, {"a P pair of 1.5 um", &narrow}}) {
        if (!*parts) return parts->error();
        const auto netlist = substitute_in_embedded_text("circuits/amplifier.cir", {{".include 'parts/transducer.inc'", **parts}});
        if (!netlist) return netlist.error();
        const auto pair = run_study_netlist({*netlist});
        if (!pair) return pair.error();
        out.claim(fmt::format("F10a: {}: transconductance at V_Y", description), pair->number("g_m"), "S");
        out.claim(fmt::format("F10a: {}: common-mode input up to (half of the transconductance)", description), pair->number("up_to"), "V");
    }
    return {};
}

/// F12: the value of V_Y.
Result<void> report_reference(StudyResult& out) {
    const double V_20 = 17 * 12e-9 / sensor.slope(20), V_400 = 17 * 4e-9 / sensor.slope(400);
    out.claim("F12: V_Y that gives 12 nA/gf at 20 gf", V_20, "V")
        .derived_as(0.1, "V_Y of our circuit")
        .explain_if_needed("no single V_Y gives both published slopes");
    out.claim("F12: V_Y that gives 4 nA/gf at 400 gf", V_400, "V")
        .derived_as(0.1, "V_Y of our circuit")
        .explain_if_needed("no single V_Y gives both published slopes");
    // A: I_F of which half is I_BIASF; I_F at 400 gf
    const double I_mid = 2 * 700e-9, max_I_F = 0.1 * sensor.conductance(400) / 17;
    out.claim("F12: force at which half of I_F is I_BIASF, at 0.1 V",
              ForceSensor{.R_0 = 1e30}.conductance_curve(1, 400).scaled(1, 0.1 / 17).crossing(I_mid), "gf")
        .allow_range(100, 300, "thesis 4.3.1: V_F is at half the supply at that force; the middle half of 0 to 400 gf is our choice");
    out.claim("F12: I_F at 400 gf, at 0.1 V", max_I_F, "A");
    StudyCurve at_20, at_400, V_Z;  // over V_Y: slopes of I_F at 20 and 400 gf (nA/gf), V_Z at 400 gf (V)
    for (const double V_Y : {0.06, 0.07, 0.08, 0.09, 0.1, 0.11, 0.12, 0.13, 0.14}) {
        const auto found = run_study_netlist({"transducer", {fmt::format("vy={}", V_Y)}, ".dc vgf 18 402 2"});
        if (!found) return found.error();
        const auto slope = found->curve("dc", "i(vif)").slope();
        for (auto [line, value] :
             {std::pair{&at_20, slope.at(20) * 1e9}, {&at_400, slope.at(400) * 1e9}, {&V_Z, found->curve("dc", "v(x.vz)").at(400)}})
            line->x.push_back(V_Y), line->y.push_back(value);
    }
    out.claim("F12: V_Y at which the netlist has 12 nA/gf at 20 gf", at_20.crossing(12), "V");
    out.claim("F12: V_Y at which the netlist has 4 nA/gf at 400 gf", at_400.crossing(4), "V");
    out.claim("F12: V_Y at which the netlist has V_Z = 525 mV at 400 gf", V_Z.crossing(0.525), "V");
    out.plot("F12: slopes over V_Y", "V_Y (V)", "dI_F/dF (nA/gf)")
        .add("at 20 gf", at_20)
        .add("at 400 gf", at_400)
        .add("12, published", {{0.06, 0.14}, {12, 12}})
        .add("4, published", {{0.06, 0.14}, {4, 4}})
        .describe_published("12 at 20 gf and 4 at 400 gf, V_Y not given");
    return {};
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    report_sensor(out);
    double done = 0;
    for (const auto report : {report_transistors, report_pair, report_reference}) {
        if (auto ok = report(out); !ok) return ok.error();
        if (auto ok = options.report_progress(done += 0.3); !ok) return ok.error();
    }
    out.note(
        "Each printed form has its own row, with the verdict \"does not hold\" or \"differs\" where the errata list a misprint. Eq. 13 is "
        "exact (F1a, eq13-15). Nothing depends on F6, F10 and F11 (a caption, names of transistors, \"are\" for \"and\"); fig20 covers "
        "F11a.");
    return out;
}

const Study study{"errata-transducer", "Misprints of sensor and transducer",
                  "The printed form compared with our circuit. Thesis 4.1 and 4.2; errata F1 to F12", compute};

}  // namespace corpuscle::studies::errata_transducer
