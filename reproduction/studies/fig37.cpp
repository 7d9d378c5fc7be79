// Fig. 37: FA-I's analog signal processing under the press stimulus: both signs of one filter's current, each with its own gain.
// I_N is the filter's current, I_A and I_B are its rectified parts for rising and falling force, I is their sum.

#include <fmt/format.h>
#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/claims/study_netlist.hpp"
#include "reproduction/thesis/chip_vs_model.hpp"

namespace corpuscle::studies::fig37 {

constexpr double K_A = 3.5, K_B = 2.75;  // uA/N, of the model (thesis 3.4)

/// The gains of the rectifier for both signs of the filter's current, with the sizes of table 8 and as intended.
Result<void> report_gains(StudyResult& out) {
    const auto found = run_study_netlist({"rectifier_fa", {}, ".dc vhp 0.31 0.39 1m"});
    if (!found) return found.error();
    const auto I_N = found->curve("dc", "i(vn)"), as_printed = found->curve("dc", "i(v3)"), intended = found->curve("dc", "i(v6)");
    const auto gain = [&](const StudyCurve& line, double v) { return std::abs(line.slope_at(v) / I_N.slope_at(v)); };
    // filter outputs of 380 and 320 mV are those of a rising and a falling force
    const double up = gain(as_printed, 0.38), down = gain(as_printed, 0.32), corrected = gain(intended, 0.32);
    out.claim("table 8: gain while the force rises", up, "times").derived_as(8, "table 8, M1A over table 5's M5B");
    out.claim("table 8: gain while the force falls", down, "times").derived_as(3, "table 8, M1B over table 5's M5B");
    out.claim_true(
        "a full-wave rectifier with different gains: both signs of the filter's current give a sinking current, one larger than the other",
        as_printed.at(0.38) > 0 && as_printed.at(0.32) > 0 && up > 1.1 * down, "thesis 4.3.2");
    out.claim("table 8: ratio of the gains", up / down, "times")
        .derived_as(K_A / K_B, "thesis 3.4, 3.5 over 2.75 uA/N of the model")
        .explain("the ratio of table 8's sizes is 8 to 3 (errata S15)");
    out.claim("as intended here, pair B 6x4: ratio of the gains", up / corrected, "times")
        .derived_as(K_A / K_B, "thesis 3.4, 3.5 over 2.75 uA/N of the model");
    return {};
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    const auto found = run_study_netlist({"asp_fa1", {}, ".save v(vf) v(hpc) i(vi) i(via) i(vib) v(xrect.en)\n.op\n.tran 1m 1 0 5m"});
    if (!found) return found.error();
    if (auto ok = report_gains(out); !ok) return ok.error();
    if (auto ok = options.report_progress(0.8); !ok) return ok.error();
    // resampled at even steps, to remove the microsecond pulses of the switches
    const auto all = found->curve("tran", "i(vi)"), I = all.resampled(0.5e-3);
    const auto I_A = found->curve("tran", "i(via)").resampled(0.5e-3), I_B = found->curve("tran", "i(vib)").resampled(0.5e-3);
    const auto model = run_trial({.afferent = "fa1", .probes = {"I"}});
    if (!model) return model.error();
    const auto& expected = model->probes.at("I");
    // the circuit's fall is read from 0.68 s on, so that its late switching is left out
    const auto up = I.between(0.26, 0.5), down = I.between(0.68, 0.9), model_up = expected.between(0.26, 0.5),
               model_down = expected.between(0.63, 0.9);
    out.claim("I: largest value while the force rises", up.max(), "A"),
        out.claim("I: largest value while the force falls", down.max(), "A");
    out.claim("I: largest value of the rise over that of the fall", up.max() / down.max(), "times")
        .derived_as(model_up.max() / model_down.max(), "the model's, thesis 3.4 and fig. 18a");
    const auto macro = run_trial({.afferent = "fa1-macro", .probes = {"i(vi)"}});
    if (!macro) return macro.error();
    const double delay_of_ideal_blocks = macro->probes.at("i(vi)").between(0.26, 0.5).x_of_max() - model_up.x_of_max();
    out.claim("I: delay of its rising peak after the model's", up.x_of_max() - model_up.x_of_max(), "s")
        .explain(fmt::format(
            "the same design of ideal blocks (fa1-macro) is {:.1f} ms late, because of the sensor's curve and a corner above the "
            "model's 2 Hz; the rest is probably V_F's compression above 500 mV",
            1e3 * delay_of_ideal_blocks));
    out.claim("I: delay of its falling peak after the model's", down.x_of_max() - model_down.x_of_max(), "s");
    out.claim_true(
        "I_A drives the rise and I_B the fall: at I's rising peak I_B is below a tenth of I_A, at its falling peak I_A below a tenth of "
        "I_B",
        std::abs(I_B.at(up.x_of_max())) < 0.1 * I_A.at(up.x_of_max()) && std::abs(I_A.at(down.x_of_max())) < 0.1 * I_B.at(down.x_of_max()),
        "thesis 4.3.2");
    out.claim("I at rest", I.at(0.2), "A").allow_range(-0.2e-12, 0.2e-12, "thesis 4.3.2: FA-I has no static current; 0.2 pA is our choice");
    const double switching_time = found->curve("tran", "v(xrect.en)").crossing(0.35, 0.63);
    auto& not_negative = out.claim_true("I is never negative", I.min() > -0.2e-12, "thesis 4.3.2, fig. 36: a full-wave rectifier");
    if (not_negative.needs_explanation())
        not_negative.explain(
            fmt::format("the comparator's input is driven by the filter's small current, so it switches {:.0f} ms after the force begins "
                        "to fall. Until then the current has the wrong sign, at most {:.0f} pA",
                        1e3 * (switching_time - 0.625), -1e12 * I.min()));
    out.claim("largest glitch when the comparator switches as the force falls (lasts microseconds)",
              all.between(switching_time - 1e-3, switching_time + 1e-3).absolute().max(), "A");
    out.plot("37a, filter output", "time (s)", "V")
        .describe_published("V_HP; the text gives no details")
        .add("V_HP", found->curve("tran", "v(hpc)"))
        .add("V_F", found->curve("tran", "v(vf)"));
    const double scale = up.max() / model_up.max();
    out.plot("37b, currents", "time (s)", "pA")
        .describe_published("I_A and I_B, rectified, whose sum is I")
        .add("I_A", I_A.scaled(1, 1e12))
        .add("I_B", I_B.scaled(1, 1e12))
        .add("the model's I, scaled to the same rising peak", expected.scaled(1, scale * 1e12));
    out.note("As in circuits/asp_fa1.cir, gains as intended (errata S15); the membrane is held at half the supply.");
    return out;
}

const Study study{"fig37", "FA-I's analog signal processing under the press stimulus",
                  "One filter's current rectified for both signs, with different gains. Thesis 4.3.2, figs. 36 and 37, table 8", compute};

}  // namespace corpuscle::studies::fig37
