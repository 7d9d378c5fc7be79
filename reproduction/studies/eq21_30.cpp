// Eq. 21 to 30, the unified current control model: the simulated transistor compared with the equations as corrected by the errata.
// Symbols. I_S is the specific current, n the slope factor, V_P the pinch-off voltage, phi_t the thermal voltage. The forward and the
// reverse inversion level are i_f and i_r. The transconductances of gate, drain, source and bulk are g_mg, g_md, g_ms and g_mb.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "circuit/device/physical_constants.hpp"
#include "reproduction/claims/check_all.hpp"
#include "reproduction/claims/studies.hpp"
#include "reproduction/claims/study_netlist.hpp"
#include "reproduction/thesis/array_text.hpp"

namespace corpuscle::studies::eq21_30 {

constexpr double W_by_L = 3, I_S = simple_I_SQ * W_by_L, V_S = 0.1, solver_accuracy = 1e-6;  // I_S in A, V_S in V, solver_accuracy in %
const double phi_t = circuit::thermal_voltage(300.15);

/// A transistor at one bias point: its current, inversion levels and slopes from the solved circuit.
struct BiasPoint {
    double V_G, V_D, I_D, i_f, i_r;  ///< V, V, A; forward and reverse inversion level
    double by_G, by_D, by_S, by_B;   ///< S: dI_D/dV_G, dI_D/dV_D, ...; by_S is negative
};

/// Solves the transistor at many bias points. The slopes are derivatives of the current at the drain; with channel_only they are those of
/// the channel alone, without the junctions in parallel.
Result<std::vector<BiasPoint>> solve_bias_points(std::string_view card, const std::string& model, bool channel_only = false) {
    const auto found = TRY(run_study_variants(
        {fmt::format(
             "a transistor\n{}vd d 0 {{vd}}\nvg g 0 {{vg}}\nvs s 0 {}\nvb b 0 0\nm1 d g s b {} w=1.5u l=0.5u\n.param vg=0.5 vd=0.5\n", card,
             V_S, model),
         {},
         ".op\n.tf i(vd) vg\n.tf i(vd) vd\n.tf i(vd) vs\n.tf i(vd) vb\n.step param vg 0.1 1.3 0.1\n.step param vd list 0.12 0.2 0.6"}));
    std::vector<BiasPoint> out;
    for (const auto& f : found) {
        const auto slope = [&](const char* source, const char* reading) {
            return channel_only ? f.operating_info("m1", reading) : -f.derivative("i(vd)", source);
        };
        out.push_back({f.operating_point("v(g)"), f.operating_point("v(d)"), -f.operating_point("i(vd)"), f.operating_info("m1", "i_f"),
                       f.operating_info("m1", "i_r"), slope("vg", "g_mg"), slope("vd", "g_md"),
                       slope("vs", "g_ms") * (channel_only ? -1 : 1), slope("vb", "g_mb")});
    }
    return out;
}

/// sqrt(1 + i) - 1, the normalised charge at inversion level i; accurate for small i too.
double charge(double i) { return i / (std::sqrt(1 + i) + 1); }
/// The function f of (23) to (25).
double f_of(double i) { return charge(i) - 1 + std::log(charge(i)); }

/// The largest |error| of an equation over all bias points, %.
double largest_error(const std::vector<BiasPoint>& all, double (*error)(const BiasPoint&)) {
    double largest = 0;
    for (const auto& point : all) largest = std::max(largest, std::abs(error(point)));
    return 100 * largest;
}

struct Equation {
    const char *label, *source;
    double (*error)(const BiasPoint&);  ///< as a fraction, except for f in (23) to (25): the absolute error
};
constexpr Equation equations[] = {
    {"(21): largest error of I_D = I_S (i_f - i_r)", "thesis eq. 21",
     [](const BiasPoint& a) { return a.I_D / (I_S * (a.i_f - a.i_r)) - 1; }},
    {"(23) to (25): largest error of f(i_f) = (V_GB - V_T0 - n V_SB)/(n phi_t)", "thesis eq. 23 to 25; errata U4",
     [](const BiasPoint& a) { return f_of(a.i_f) - (a.V_G - simple_V_T0 - simple_n * V_S) / (simple_n * phi_t); }},
    {"(23) to (25): largest error of f(i_r) = (V_GB - V_T0 - n V_DB)/(n phi_t)", "thesis eq. 23 to 25",
     [](const BiasPoint& a) { return f_of(a.i_r) - (a.V_G - simple_V_T0 - simple_n * a.V_D) / (simple_n * phi_t); }},
    {"(27): largest error of g_ms = g_mg + g_md + g_mb", "thesis eq. 27; g_ms = -dI_D/dV_S",
     [](const BiasPoint& a) { return (a.by_G + a.by_D + a.by_B) / -a.by_S - 1; }},
    {"(28): largest error of g_ms = 2 I_S/phi_t (sqrt(1 + i_f) - 1)", "thesis eq. 28",
     [](const BiasPoint& a) { return -a.by_S * phi_t / (2 * I_S * charge(a.i_f)) - 1; }},
    {"(28): largest error of g_md = 2 I_S/phi_t (sqrt(1 + i_r) - 1), relative to g_ms", "thesis eq. 28",
     [](const BiasPoint& a) { return (a.by_D - 2 * I_S / phi_t * charge(a.i_r)) / -a.by_S; }},
    {"(29), corrected: largest error of g_mb/g_mg = n - 1", "errata U5",
     [](const BiasPoint& a) { return a.by_B / a.by_G / (simple_n - 1) - 1; }},
    {"(30): largest error of g_mg = (g_ms - g_md)/n", "thesis eq. 30",
     [](const BiasPoint& a) { return a.by_G * simple_n / (-a.by_S - a.by_D) - 1; }},
};

void add_errata(StudyResult& out, const std::vector<BiasPoint>& all) {
    out.claim_true("(26): dI_D/dV_S is negative at all points; g_ms > 0 of (27) and (28) is its negative",
                   std::all_of(all.begin(), all.end(), [](const BiasPoint& a) { return a.by_S < 0; }), "errata U2");
    const auto& a = all.back();  // any point would do
    out.claim("g_mb/g_mg, equations only", a.by_B / a.by_G).derived_as(simple_n - 1, "thesis eq. 29, inverted: errata U5");
    out.claim_true("g_mg/g_mb, as (29) prints it, is 1/(n - 1), not n - 1", std::abs(a.by_G / a.by_B * (simple_n - 1) - 1) < 1e-9,
                   "errata U5");
}

/// f(i) and its asymptotes.
StudyPlot inversion_plot() {
    StudyPlot out{"Eq. 23: inversion level over the pinch-off voltage", "(V_P - V_S)/phi_t", "i_f", {}, false, true};
    StudyCurve exact, weak, strong;
    for (double u = -2.3; u < 1.4; u += 0.05) {  // logarithm of the normalised charge q
        const double q = std::pow(10, u), i = q * (q + 2), x = f_of(i);
        exact.x.push_back(x), exact.y.push_back(i);
        if (x < 1) weak.x.push_back(x), weak.y.push_back(2 * std::exp(x + 1));
        if (x > 1) strong.x.push_back(x), strong.y.push_back(x * x);
    }
    return out.add("eq. 23", exact).add("weak: 2 exp(x + 1), as eq. 42", weak).add("strong: x^2", strong);
}

Result<StudyResult> compute(const StudyOptions&) {
    const auto simple = solve_bias_points(simple_card, "plain"), complete = solve_bias_points(process_card, "nch"),
               channel = solve_bias_points(process_card, "nch", true);
    TRY(check_all(simple, complete, channel));
    StudyResult out;
    for (const auto& e : equations) out.claim(e.label, largest_error(*simple, e.error), "%").allow_max(solver_accuracy, e.source);
    add_errata(out, *simple);
    const auto pinched_off = TRY(run_study_netlist(
        {fmt::format("pinch-off\n{}vd d 0 1\nvg g 0 {}\nm1 d g 0 0 plain w=1u l=1u\n", simple_card, simple_V_T0), {}, ".op"}));
    out.claim("(23): i_f where V_P = V_S", pinched_off.operating_info("m1", "i_f")).derived_as(3, "thesis eq. 23; errata U4");
    const auto card = TRY(elaborate_study_netlist({fmt::format("card\n{}m1 0 0 0 0 nch w=1u l=1u\n", process_card), {}, ".op"}));
    for (const auto& m : card->models)
        if (m.name == "nch")
            out.claim("(22): mobility that follows from the card's I_SQ, C_ox and n",
                      2e4 * m.values.at("isq") / (m.values.at("cox") * m.values.at("n") * phi_t * phi_t), "cm^2/(V s)")
                .allow_range(200, 500, "usual for electrons at 0.18 um");
    for (const auto& e : {equations[3], equations[6], equations[7]}) {  // (27), (29), (30)
        out.claim(fmt::format("process card, channel only, {}", e.label), largest_error(*channel, e.error), "%")
            .allow_max(solver_accuracy, e.source);
        out.claim(fmt::format("process card, with junctions, {}", e.label), largest_error(*complete, e.error), "%");
    }
    // (28) for g_ms
    out.claim(fmt::format("process card, {}", equations[4].label), largest_error(*complete, equations[4].error), "%");
    out.note(
        "The process card adds velocity saturation and length modulation to these equations. (27), (29) and (30) still hold; (28) deviates "
        "by these effects, most in strong inversion.");
    out.plots = {inversion_plot()};
    return out;
}

const Study study{"eq21-30", "The transistor's equations",
                  "Currents, inversion and slopes of the unified current control model. Thesis app. A, eq. 21 to 30; errata U2, U4, U5",
                  ClaimKind::identity, compute};

}  // namespace corpuscle::studies::eq21_30
