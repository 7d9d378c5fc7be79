// Figs. 48 and 49: a transistor as a diode with its bulk at the source (X), at the gate (Y), and at the gate through a second transistor,
// M_Z0, which limits the bulk current (Z).
// I_DY, I_BY and I_SY are drain, bulk and source current of Y; V_Y is its voltage; in the same way for X and Z.

#include <fmt/format.h>
#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/claims/study_netlist.hpp"

namespace corpuscle::studies::fig48_49 {

constexpr double plot_to = 0.9, min_plotted_current = 1e-13;  // V, A: limits of the plots
constexpr double weak = 10e-9, moderate = 1e-6;               // A: currents at which X and Y are compared

/// Sum of two curves with the same x.
StudyCurve sum(const StudyCurve& a, const StudyCurve& b) {
    StudyCurve out = a;
    for (std::size_t k = 0; k < out.y.size(); ++k) out.y[k] += b.y[k];
    return out;
}

/// The part of a curve within the plot's limits, in nA, for a logarithmic axis.
StudyCurve plotted_part(const StudyCurve& I) {
    StudyCurve out;
    for (std::size_t k = 0; k < I.x.size(); ++k)
        if (I.x[k] <= plot_to && I.y[k] > min_plotted_current) out.x.push_back(I.x[k]), out.y.push_back(1e9 * I.y[k]);
    return out;
}

StudyCurve swap_axes(const StudyCurve& curve) { return {curve.y, curve.x}; }

/// Curves over the voltage across the diodes, V.
struct Diodes {
    StudyCurve X, Y, B_Y, Z, B_Z;  ///< A: drain currents of X, Y and Z, bulk currents of Y and Z
    StudyCurve bulk;               ///< V: bulk voltage of Z
};

void add_currents(StudyResult& out, const Diodes& d) {
    const std::string source = "thesis app. D, fig. 49";
    const double at = d.Y.crossing(weak);
    out.claim("I_BY over I_DY in weak inversion, at 10 nA", d.B_Y.at(at) / d.Y.at(at))
        .allow_max(0.01, source + ": I_DY is much larger (a hundredth here)");
    out.claim("I_SY over I_DY in weak inversion, at 10 nA", sum(d.Y, d.B_Y).at(at) / d.Y.at(at)).derived_as(1, source + ": approximately");
    // voltage (V) for a factor of ten in the current, from the slope at `from` (V)
    const auto decade = [](const StudyCurve& I, double from) { return 0.06 / std::log10(I.at(from + 0.06) / I.at(from)); };
    out.claim("I_BY: voltage per decade of current at 0.4 V", decade(d.B_Y, 0.4), "V")
        .allow_range(0.055, 0.07, source + ": increases exponentially (60 mV times an ideality factor)");
    out.claim("I_BY: voltage per decade at 0.7 V over that at 0.4 V", decade(d.B_Y, 0.7) / decade(d.B_Y, 0.4))
        .derived_as(1, source + ": does not stop increasing exponentially");
    out.claim("I_DY: voltage per decade at 0.7 V over that at 0.15 V", decade(d.Y, 0.7) / decade(d.Y, 0.15))
        .allow_min(2, source + ": stops increasing exponentially (half as steep here)");
    StudyCurve difference = d.B_Y;
    for (std::size_t k = 0; k < difference.y.size(); ++k) difference.y[k] -= d.Y.y[k];
    out.claim("I_BY exceeds I_DY from", difference.crossing(0, 0.3), "V")
        .allow_max(1, source + ": until I_BY is greater; no number is published, the ends of the axes are lost");
}

void add_voltages(StudyResult& out, const Diodes& d, double n) {
    const std::string source = "thesis eq. 44";
    for (const auto& [I, where] : {std::pair{weak, "10 nA"}, {moderate, "1 uA"}}) {
        const double V_X = d.X.crossing(I), V_Y = d.Y.crossing(I);
        out.claim(fmt::format("V_X/V_Y at {}", where), V_X / V_Y).derived_as(n, source + ": n");
        out.claim(fmt::format("Delta V_T = V_X - V_Y at {}", where), V_X - V_Y, "V").derived_as((n - 1) * V_Y, source + ": (n - 1) V_Y");
        out.claim_true(fmt::format("V_X > V_Y at {}", where), V_X > V_Y, "thesis app. D");
    }
}

void add_augmented(StudyResult& out, const Diodes& d) {
    const std::string source = "thesis app. D, fig. 48c: M_Z0 limits the parasitic bulk current";
    out.claim("Z: largest I_BZ up to the supply of 0.7 V", d.B_Z.between(0, 0.7).max(), "A")
        .allow_max(d.B_Y.at(0.7) / 10, source + " (a tenth of I_BY here)");
    out.claim("Z: largest bulk voltage up to 0.7 V", d.bulk.between(0, 0.7).max(), "V").allow_max(0.7, source);
    out.claim("Z: I_DZ over I_DY at 0.2 V", d.Z.at(0.2) / d.Y.at(0.2))
        .derived_as(1, "Z acts as Y (fig. 48b) while the bulk current is small");
    out.claim("Z: I_DZ over I_DY at 0.6 V, where the limit takes effect", d.Z.at(0.6) / d.Y.at(0.6))
        .allow_range(0.5, 1, "Z acts as Y with less body bias");
}

Result<StudyResult> compute(const StudyOptions&) {
    const auto found = run_study_netlist({"body_diodes", {}, ".dc vin 0 0.95 1m"});
    if (!found) return found.error();
    const auto curve = [&](const char* name) { return found->curve("dc", name); };
    const Diodes d{curve("i(vdx)"), curve("i(vdy)"), curve("i(vby)"), curve("i(vdz)"), curve("i(vbz)"), curve("v(bz0)")};
    double n = 0;
    for (const auto& m : found->circuit->models)
        if (m.name == "nch") n = m.values.at("n");
    StudyResult out;
    add_currents(out, d);
    add_voltages(out, d, n);
    add_augmented(out, d);
    StudyPlot by_voltage{"Currents of the diodes (49a)", "V_X, V_Y, V_Z (V)", "nA", {}, false, true};
    by_voltage.add("I_DX", plotted_part(d.X))
        .add("I_DY", plotted_part(d.Y))
        .add("I_BY", plotted_part(d.B_Y))
        .add("I_SY = I_DY + I_BY", plotted_part(sum(d.Y, d.B_Y)))
        .add("I_DZ", plotted_part(d.Z))
        .add("I_BZ", plotted_part(d.B_Z));
    StudyPlot by_current{"Voltages of the diodes (49b)", "I (nA)", "V", {}, true};
    by_current.add("V_X", swap_axes(plotted_part(d.X)))
        .add("V_Y", swap_axes(plotted_part(d.Y)))
        .add("n V_Y", swap_axes(plotted_part(d.Y)).scaled(1, n))
        .add("V_Z", swap_axes(plotted_part(d.Z)));
    out.plots = {
        by_voltage.describe_published(
            "I_DY far above I_DX and I_BY in weak inversion; I_BY continues exponentially and exceeds I_DY; I_SY equals I_DY until then"),
        by_current.describe_published("V_X above V_Y at every current, about n V_Y")};
    out.note(
        "Unit transistors of 1.5/0.5 um of the process card; the thesis uses \"low-V_T\" ones and does not give their size. The figures "
        "are 48a to 48c (errata C8), the bulk of X is at its source (C7), and forward-biasing an NMOS's bulk requires a separate well "
        "(C9).");
    return out;
}

const Study study{"fig48-49", "A transistor as a diode with forward-biased bulk",
                  "Currents and voltages of a plain, a body-biased and an augmented body-biased diode. Thesis app. D, figs. 48 and 49",
                  compute};

}  // namespace corpuscle::studies::fig48_49
