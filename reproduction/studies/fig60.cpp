// Fig. 60: INVC's current and transconductance compared with INVB's. V_IN is relative to half the supply.

#include <fmt/format.h>
#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/inverters.hpp"

namespace corpuscle::studies::fig60 {

/// Largest difference between two normalised curves for V_IN from -within to within (V), over the largest absolute value of the first.
double largest_difference(const StudyCurve& a, const StudyCurve& b, double within) {
    double out = 0;
    for (std::size_t k = 0; k < a.x.size(); ++k)
        if (std::abs(a.x[k]) <= within) out = std::max(out, std::abs(a.y[k] - b.at(a.x[k])));
    return out / a.absolute().max();
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    const auto all = InverterSweep::run(2e-3);
    if (!all) return all.error();
    const double G_B = all->transconductance_at_zero('b'), G_C = all->transconductance_at_zero('c');
    const auto I_B = all->output_current('b').scaled(1, 1 / G_B), I_C = all->output_current('c').scaled(1, 1 / G_C);
    // division of the transconductance by the ratios of table 20 only: M3 and M4 split the current (eq. 38, 39), M5 and M6 divide it
    const auto by_ratios = [] {
        constexpr double wide = 8, narrow = 2.0 / 4, last = (2.0 / 8) / 16;
        return 1 / (narrow * narrow / (wide * (wide + 2 * narrow)) * last);
    }();
    const auto why = fmt::format(
        "the ratios of table 20 alone give {:.5g} (errata S7b); the rest is length modulation of the parallel diodes. Why the foundry's "
        "mirrors divide by less is not known",
        by_ratios);
    auto& G = out.claim("INVC: transconductance at V_IN = 0", G_C, "S").published_as(146e-12, "E.4, fig. 60b");
    if (G.needs_explanation()) G.explain(why);
    auto& ratio =
        out.claim("INVB's transconductance over INVC's", G_B / G_C, "times").published_as(16000, "E.4: approximately 16000 times less");
    if (ratio.needs_explanation()) ratio.explain(why);
    out.claim("INVB's transconductance over INVC's by the ratios of table 20 only", by_ratios, "times")
        .published_as(16000, "E.4")
        .explain("8x1 and 2x4 split by 1/288, not 1/256: errata S7b");
    out.claim("INVB's transconductance over INVC's from the published values only", 2.5e-6 / 146e-12, "times")
        .published_as(16000, "E.4: 2.5 uS and 146 pS");
    const auto current = all->output_current('c');
    out.claim("INVC: current at V_IN = -350 mV", current.y.front(), "A").allow_range(1e-12, 999e-12, "E.4: in the pico ampere range");
    out.claim("INVC: current at V_IN = 350 mV", -current.y.back(), "A").allow_range(1e-12, 999e-12, "E.4: in the pico ampere range");
    auto& shape = out.claim("largest difference of INVC's normalised current from INVB's", 100 * largest_difference(I_B, I_C, 0.35), "%")
                      .allow_max(5, "E.4: the exact same shape; a twentieth is our choice");
    if (shape.needs_explanation())
        shape.explain("the mirrors divide by more where they carry less current, because their diodes then have less drain voltage");
    out.plot("Fig. 60a: output currents", "V_IN (mV)", "I_o (INVB: uA, INVC: 20 pA)")
        .add("INVB", all->output_current('b').scaled(1e3, 1e6))
        .add("INVC", current.scaled(1e3, 0.05e12))
        .describe_published("INVC's has exactly the same shape as INVB's, in the picoampere range");
    auto& both = out.plot("Fig. 60b: transconductances", "V_IN (mV)", "G_m (S)");
    both.log_y = true;
    for (int k = 0; k < 3; ++k) both.add(inverter_names[k], all->transconductance(inverter_letters[k]).scaled(1e3, 1));
    both.points("published", {{0, 0}, {2.5e-6, 146e-12}}).describe_published("146 pS at V_IN = 0");
    out.plot("Normalised currents, over the transconductance at 0", "V_IN (mV)", "I_o / G_m(0) (mV)")
        .add("INVB", I_B.scaled(1e3, 1e3))
        .add("INVC", I_C.scaled(1e3, 1e3));
    return options.report_progress(0.9) ? Result<StudyResult>(out) : options.report_progress(0.9).error();
}

const Study study{
    "fig60", "INVC's current and transconductance",
    "About 146 pS, 16000 times less than INVB's, with the same shape and picoampere currents. Thesis E.4, fig. 60 (errata S7, S8)",
    compute};

}  // namespace corpuscle::studies::fig60
