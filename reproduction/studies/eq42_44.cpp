// Eq. 42 to 44: a transistor in weak inversion with its bulk forward biased, the current of the junction, and the effect of body bias.

#include <fmt/format.h>
#include <cmath>
#include <numbers>

#include "circuit/device/physical_constants.hpp"
#include "reproduction/claims/studies.hpp"
#include "reproduction/claims/study_netlist.hpp"
#include "reproduction/thesis/array_text.hpp"

namespace corpuscle::studies::eq42_44 {

constexpr double W_by_L = 3;  // of a unit transistor of 1.5/0.5 um
const double phi_t = circuit::thermal_voltage(300.15);

/// (42) in saturation (V_D = 0.6 V). Its relative error is of the order of the inversion level i_f, so it holds in weak inversion only.
Result<void> add_42(StudyResult& out) {
    const auto found = TRY(run_study_variants(
        {fmt::format("weak\n{}vd d 0 0.6\nvg g 0 {{vg}}\nvb b 0 {{vb}}\nm1 d g 0 b plain w=1.5u l=0.5u\n.param vg=0.2 vb=0\n", simple_card),
         {},
         ".op\n.step param vb list 0 0.1 0.2\n.step param vg 0.05 0.5 0.025"}));
    StudyPlot plot{"Eq. 42 against the complete equations, V_BS = 0.2 V", "V_GS (V)", "I_D (nA)", {}, false, true};
    StudyCurve weak, complete;
    double worst = 0, worst_without_2 = 0;
    for (const auto& f : found) {
        const double V_G = f.operating_point("v(g)"), V_B = f.operating_point("v(b)"), I = -f.operating_point("i(vd)"),
                     i_f = f.operating_info("m1", "i_f");
        const double by_42 =
            2 * std::numbers::e * simple_I_SQ * W_by_L * std::exp((V_G + (simple_n - 1) * V_B - simple_V_T0) / (simple_n * phi_t));
        if (i_f < 0.01)
            worst = std::max(worst, std::abs(by_42 / I - 1)), worst_without_2 = std::max(worst_without_2, std::abs(by_42 / 2 / I - 1));
        if (V_B > 0.15) weak.x.push_back(V_G), weak.y.push_back(1e9 * by_42), complete.x.push_back(V_G), complete.y.push_back(1e9 * I);
    }
    out.claim("(42): largest error against the complete equations where i_f < 0.01", 100 * worst, "%")
        .allow_max(1, "thesis eq. 42, its factor 2 e (errata I1); i_f << 1");
    out.claim("(42) without the factor 2, as printed in (45a) and (45b): largest error where i_f < 0.01", 100 * worst_without_2, "%")
        .allow_range(49, 51, "errata I1: a factor of two");
    out.plots.push_back(plot.add("eq. 42", weak).add("complete equations", complete));
    return {};
}

/// The bulk-source junction with the process card's saturation currents (area and sidewall). n_dio is its emission coefficient.
Result<void> add_43(StudyResult& out) {
    const auto found =
        run_study_netlist({fmt::format("junction\n{}vd d 0 0.9\nvb b 0 0\nm1 d 0 0 b nch w=1.5u l=0.5u\n.options gmin=0\n", process_card),
                           {},
                           ".dc vb 0.2 0.7 5m"});
    if (!found) return found.error();
    StudyCurve logarithm;
    const auto I = found->curve("dc", "i(vb)").scaled(1, -1);
    for (std::size_t k = 0; k < I.x.size(); ++k) logarithm.x.push_back(I.x[k]), logarithm.y.push_back(std::log(I.y[k]));
    const auto fit = logarithm.fit_line();
    double n_dio = 0;
    for (const auto& m : found->circuit->models)
        if (m.name == "nch") n_dio = m.values.at("nj");
    out.claim("(43): n_dio of I_B from 0.2 to 0.7 V", 1 / (fit.slope * phi_t))
        .derived_as(n_dio, "thesis eq. 43; value of the process card");
    out.claim("(43): largest difference of ln I_B from a straight line", 100 * fit.max_deviation, "%")
        .allow_max(2, "thesis eq. 43: an exponential");
    out.claim("(43): I_Sdio of one unit transistor of 1.5/0.5 um", std::exp(fit.intercept), "A");
    return {};
}

/// (44): the voltage V_X of a diode-connected transistor with a grounded bulk, and V_Y of one with its bulk at its gate. At equal currents
/// in weak inversion V_X = n V_Y: exact in the simple model, because the exponents are equal.
Result<void> add_44(StudyResult& out) {
    const auto found = TRY(run_study_netlist(
        {fmt::format("diodes\n{}ix 0 x 1n\niy 0 y 1n\nmx x x 0 0 plain w=1.5u l=0.5u\nmy y y 0 y plain w=1.5u l=0.5u\n", simple_card),
         {},
         ".op"}));
    const double V_X = found.operating_point("v(x)"), V_Y = found.operating_point("v(y)");
    out.claim("(44): V_X/V_Y at 1 nA, equations only", V_X / V_Y).derived_as(simple_n, "thesis eq. 44");
    out.claim("(44): i_fX/i_fY at 1 nA", found.operating_info("mx", "i_f") / found.operating_info("my", "i_f"))
        .derived_as(1, "thesis app. D: about the same");
    out.claim_true("the voltage of the body-biased diode is V_Y, the lower one", V_Y < V_X, "errata C8");
    return {};
}

Result<StudyResult> compute(const StudyOptions&) {
    StudyResult out;
    for (const auto add : {add_42, add_43, add_44}) TRY(add(out));
    return out;
}

const Study study{
    "eq42-44", "Weak inversion, junctions, body bias",
    "The exponential characteristics of a body-biased transistor and of its junction. Thesis app. D, eq. 42 to 44; errata I1, C7, C8",
    ClaimKind::identity, compute};

}  // namespace corpuscle::studies::eq42_44
