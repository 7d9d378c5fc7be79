// Fig. 58: the curves of fig. 57, each divided by the inverter's transconductance at V_IN = 0, which is half the supply.

#include <fmt/format.h>
#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/inverters.hpp"

namespace corpuscle::studies::fig58 {

StudyCurve normalise(const StudyCurve& line, double by) { return line.scaled(1, 1 / by); }

/// Largest deviation from 1 of a normalised transconductance, for V_IN from -within to within (V).
double largest_deviation(const StudyCurve& G, double within) {
    const auto part = G.between(-within, within);
    return std::max(part.max() - 1, 1 - part.min());
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    const auto at_700_mV = InverterSweep::run(2e-3), at_800_mV = InverterSweep::run(2e-3, 0.8);
    for (const auto* s : {&at_700_mV, &at_800_mV})
        if (!*s) return s->error();
    out.plot("Fig. 58a: output current over G_m(0)", "V_IN (mV)", "I_o / G_m(0) (mV)");
    out.plot("Fig. 58b: transconductance over its value at 0", "V_IN (mV)", "G_m / G_m(0)");
    StudyCurve G[2];  // normalised transconductances of INVA and INVB at 0.7 V
    for (int k = 0; k < 2; ++k) {
        const char inverter = inverter_letters[k];
        G[k] = normalise(at_700_mV->transconductance(inverter), at_700_mV->transconductance_at_zero(inverter));
        out.plots[0].add(inverter_names[k],
                         normalise(at_700_mV->output_current(inverter), at_700_mV->transconductance_at_zero(inverter)).scaled(1e3, 1e3));
        out.plots[1].add(inverter_names[k], G[k].scaled(1e3, 1));
    }
    out.plots[0].add("linear", {{-350, 350}, {350, -350}}).describe_published("INVB's is the more linear one");
    out.plots[1].describe_published("INVA's is symmetrical but highly non-linear, INVB's still non-linear, but better");
    for (const double within : {0.1, 0.2, 0.34}) {
        for (int k = 0; k < 2; ++k)
            out.claim(fmt::format("{}: deviation of G_m from its value at 0 within {:g} mV", inverter_names[k], 1e3 * within),
                      100 * largest_deviation(G[k], within), "%");
        out.claim_true(fmt::format("INVB's deviation is smaller than INVA's within {:g} mV", 1e3 * within),
                       largest_deviation(G[1], within) < largest_deviation(G[0], within), "E.3: INVB is still non-linear, but better");
    }
    const auto G_at_800_mV = normalise(at_800_mV->transconductance('b'), at_800_mV->transconductance_at_zero('b'));
    out.claim_true("INVB's deviation within 200 mV is smaller at 0.8 V than at 0.7 V",
                   largest_deviation(G_at_800_mV, 0.2) < largest_deviation(G[1], 0.2),
                   "E.3: even better results with higher supply voltages");
    out.claim("INVB at 0.8 V: transconductance over that at 0.7 V",
              at_800_mV->transconductance_at_zero('b') / at_700_mV->transconductance_at_zero('b'), "times")
        .allow_min(1, "E.3: the transconductance would also increase accordingly");
    if (auto& last = out.claims.back(); last.needs_explanation())
        last.explain("the bias generator keeps 200 nA at any supply, and so it keeps the transconductance");
    return options.report_progress(0.9) ? Result<StudyResult>(out) : options.report_progress(0.9).error();
}

const Study study{"fig58", "Normalised current and transconductance of INVA and INVB",
                  "INVB's normalised transconductance is still non-linear, but better than INVA's, and better still with a higher supply. "
                  "Thesis E.3, fig. 58",
                  compute};

}  // namespace corpuscle::studies::fig58
