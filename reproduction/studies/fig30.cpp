// Fig. 30: the high-pass filters' transconductor (INVC with its output tied to its input) and its corner frequencies with 0.8 and 8.8 pF.

#include <fmt/format.h>
#include <cmath>
#include <numbers>

#include "reproduction/claims/studies.hpp"
#include "reproduction/claims/study_netlist.hpp"
#include "reproduction/thesis/active_load.hpp"

namespace corpuscle::studies::fig30 {

constexpr auto source = "thesis 4.3.1, fig. 30";
constexpr double C_B = 0.8e-12, C_C = 8.8e-12;  // F, table 5's text, errata S4

/// Both transconductors as loads, each with its output tied to its input.
struct Loads {
    ActiveLoad b, c;  ///< INVB and INVC
    double ratio() const { return c.max_resistance / b.max_resistance; }
};
/// `model_parameters` are set in all models.
Result<Loads> simulate_loads(const circuit::Values& model_parameters = {}) {
    const auto found = run_study_netlist({"invc", {}, ".dc vin 0 0.7 0.5m", model_parameters});
    if (!found) return found.error();
    // invc.cir holds the output of its INVB at half the supply, so INVB as a load is taken from invb.cir.
    const auto b = run_study_netlist({"invb", {}, ".dc vin 0 0.7 0.5m", model_parameters});
    if (!b) return b.error();
    return Loads{analyse_load(b->curve("dc", "i(vin)").scaled(1, -1)), analyse_load(found->curve("dc", "i(vl)"))};
}

struct CornerFrequencies {
    double B, C;              ///< Hz: of filters B and C, at a phase of 45 degrees
    double alone_B, alone_C;  ///< Hz: without parasitic capacitance, G / (2 pi C); from the gain at 1 mHz, which is 1 mHz over it
    double top_B, top_C;      ///< largest gain, which is reached far above the corners
};
Result<CornerFrequencies> simulate_corners(const std::vector<std::string>& settings = {}) {
    const auto found = run_study_netlist({"high_pass", settings,
                                          ".ac dec 50 1m 10k\n.meas ac f_b when vp(hpb)=0.785398\n.meas ac f_c when vp(hpc)=0.785398\n"
                                          ".meas ac low_b find vm(hpb) at=1m\n.meas ac low_c find vm(hpc) at=1m\n"
                                          ".meas ac top_b max vm(hpb)\n.meas ac top_c max vm(hpc)"});
    if (!found) return found.error();
    return CornerFrequencies{found->number("f_b"),          found->number("f_c"),   1e-3 / found->number("low_b"),
                             1e-3 / found->number("low_c"), found->number("top_b"), found->number("top_c")};
}

/// Largest difference between the resistances of INVC and INVB, each as a fraction of its own largest, from one input voltage to another
/// (V).
double largest_difference(const Loads& loads, double from, double to) {
    double largest = 0;
    const auto c = loads.c.resistance.between(from, to);
    for (std::size_t k = 0; k < c.x.size(); ++k)
        largest = std::max(largest, std::abs(c.y[k] / loads.c.max_resistance - loads.b.resistance.at(c.x[k]) / loads.b.max_resistance));
    return largest;
}

/// ideal: without length modulation.
void add_claims(const Loads& loads, const Loads& ideal, StudyResult& out) {
    const auto why = fmt::format(
        "by their ratios INVC's mirrors divide by 288 x 64 = 18432 (eq. 38, 39; errata S7b); simulated without length modulation they "
        "divide by {:.0f}. With length modulation the mirrors' diodes have a larger drain-source voltage than the series arrays, so the "
        "currents are divided by more. Why the foundry's mirrors divide by less than the ratios is not known",
        ideal.ratio());
    out.claim("largest resistance", loads.c.max_resistance, "ohm").published_as(6.6e9, source).explain(why);
    out.claim("largest resistance over INVB's", loads.ratio(), "times").published_as(16000, source).explain(why);
    out.claim("without length modulation: largest resistance over INVB's", ideal.ratio(), "times")
        .derived_as(18432, "eq. 38 and 39, errata S7b");
    out.claim("zero input current at", loads.c.zero_current_voltage, "V")
        .derived_as(350e-3, "thesis 4.3.1: the same shape as fig. 28a, which is zero at 350 mV");
    out.claim("largest resistance at", loads.c.max_resistance_at, "V")
        .derived_as(350e-3, "thesis 4.3.1: the same shape as fig. 28b, whose maximum is at 350 mV");
    out.claim("resistance as a fraction of its largest, largest difference from INVB's, 200 to 500 mV", largest_difference(loads, 0.2, 0.5))
        .allow_max(0.1, "thesis 4.3.1: \"a similar shape\"; a tenth is our choice");
}

void add_claims(const CornerFrequencies& f, StudyResult& out) {
    // F: in parallel with C_B; it lowers the corner from alone_B to B
    const double parasitic = C_B * (f.alone_B / f.B - 1);
    const auto why = fmt::format(
        "INVC's resistance is larger than published, and its node has a parasitic capacitance in parallel: {:.2g} pF for filter B, from "
        "the corner with and without it",
        1e12 * parasitic);
    out.claim("corner of filter B", f.B, "Hz").published_as(30, source).explain(why);
    out.claim("corner of filter C", f.C, "Hz").published_as(2.7, source).explain(why);
    out.claim("corner of filter B by its capacitor only, G_m / 2 pi C", f.alone_B, "Hz")
        .published_as(30, source)
        .explain("the resistance of INVC is larger than published");
    out.claim("corner of filter C by its capacitor only, G_m / 2 pi C", f.alone_C, "Hz")
        .published_as(2.7, source)
        .explain("the resistance of INVC is larger than published");
    out.claim("with the published 6.6 Gohm and the capacitor only: corner of filter B", 1 / (2 * std::numbers::pi * 6.6e9 * C_B), "Hz")
        .published_as(30, source);
    out.claim("with the published 6.6 Gohm and the capacitor only: corner of filter C", 1 / (2 * std::numbers::pi * 6.6e9 * C_C), "Hz")
        .published_as(2.7, source);
    out.claim("parasitic capacitance of filter B's node", parasitic, "F");
    out.claim("filter B: signal lost by the parasitic capacitance far above the corner", 100 * (1 - f.top_B), "%");
    out.claim("filter C: signal lost by the parasitic capacitance far above the corner", 100 * (1 - f.top_C), "%");
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    const auto loads = simulate_loads(), ideal = simulate_loads(ideal_mirrors);
    if (!loads) return loads.error();
    if (!ideal) return ideal.error();
    const auto f = simulate_corners(), with_800_pF = simulate_corners({"cb=800p"});
    if (!f) return f.error();
    if (!with_800_pF) return with_800_pF.error();
    if (auto ok = options.report_progress(0.9); !ok) return ok.error();
    add_claims(*loads, *ideal, out);
    add_claims(*f, out);
    out.claim("with the printed 800 pF: corner of filter B", with_800_pF->B, "Hz")
        .published_as(30, source)
        .explain("\"800 pF\" is 800 fF: 20 x 20 um at 2 fF/um^2, and eleven of them are the 8.8 pF of the same sentence (errata S4)");
    out.plot("30a, input current over input voltage", "V_IN (mV)", "current (pA)")
        .describe_published("like fig. 28a, in picoamperes")
        .add("into INVC as a load", loads->c.current.scaled(1e3, 1e12));
    out.plot("30b, resistance over input voltage", "V_IN (mV)", "resistance (Gohm)")
        .describe_published("at most 6.6 Gohm")
        .add("INVC as a load", loads->c.resistance.between(0.1, 0.6).scaled(1e3, 1e-9))
        .add("INVB as a load, times 16000", loads->b.resistance.between(0.1, 0.6).scaled(1e3, 16000e-9))
        .points("published", {{350}, {6.6}});
    return out;
}

const Study study{"fig30", "The high-pass filters' transconductor and their corner frequencies",
                  "6.6 Gohm, 16000 times the other transconductor; corners at 30 and 2.7 Hz. Thesis 4.3.1, fig. 30", compute};

}  // namespace corpuscle::studies::fig30
