// Fig. 61: transfer curves and voltage gains of the three inverters, outputs open. V_IN and V_OUT are relative to half the supply.

#include <fmt/format.h>
#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/inverters.hpp"

namespace corpuscle::studies::fig61 {

/// A coarse sweep over all of V_IN, and a fine one where the outputs switch.
struct Curves {
    InverterSweep coarse, fine;
    static Result<Curves> simulate() {
        auto coarse = InverterSweep::run(2e-3);
        if (!coarse) return coarse.error();
        auto fine = InverterSweep::run_with_directives(".dc vin 0.34 0.36 20u");
        if (!fine) return fine.error();
        return Curves{std::move(*coarse), std::move(*fine)};
    }
    /// Voltage (V, relative to V_SS) at which the output equals the input.
    double V_Q(char inverter) const {
        auto distance = fine.transfer_curve(inverter);
        for (std::size_t k = 0; k < distance.x.size(); ++k) distance.y[k] -= distance.x[k];
        return 0.35 + distance.crossing(0);
    }
    /// Output range (V) for inputs from rail to rail.
    double swing(char inverter) const {
        const auto curve = coarse.transfer_curve(inverter);
        return curve.max() - curve.min();
    }
    double largest_gain(char inverter) const { return fine.voltage_gain(inverter).max(); }
    /// Output range (V) in which the gain is at least half of its largest.
    double half_gain_range(char inverter) const {
        const auto gain = fine.voltage_gain(inverter);
        const double half = 0.5 * gain.max();
        double from = Claim::none, to = Claim::none;
        for (std::size_t k = 0; k < gain.x.size(); ++k)
            if (gain.y[k] >= half) (from == from ? to : from) = gain.x[k];  // the first one is `from`, which is NaN before
        return to - from;
    }
};

/// Compares INVC's gain with those of INVA and INVB. A gain is G_m / I times half an Early voltage, with the current I of the branch. With
/// the process card all arrays of eight unit transistors in series have the same Early voltage, so G_m / I decides.
void claim_gains(StudyResult& out, const Curves& c) {
    const auto per_current = [&](char inverter, double branch_current) {
        return c.coarse.transconductance_at_zero(inverter) / branch_current;
    };
    const double ratio_A = per_current('a', c.coarse.supply_current('a').at(0)),
                 ratio_C = per_current('b', 0.5 * c.coarse.supply_current('b').at(0));
    out.claim("INVA: G_m over the current of one branch", ratio_A, "1/V");
    out.claim("INVC: G_m over the current of one branch, of its INVB, in each of the two mirrored branches", ratio_C, "1/V");
    for (const char inverter : {'b', 'a'}) {
        const auto statement = fmt::format("INVC's gain is larger than {}'s", inverter_names[inverter - 'a']);
        auto& claim = out.claim_true(statement, c.largest_gain('c') > c.largest_gain(inverter),
                                     "E.4: INVC voltage gain is also bigger; the text does not say which gain it is compared with");
        if (claim.needs_explanation())
            claim.explain(
                inverter == 'a'
                    ? "degeneration reduces G_m over current, and by the process card its output has the same Early voltage as INVA's. A "
                      "larger Early voltage of the foundry's transistors at picoamperes would explain it, but is not known"
                    : "degeneration raises INVB's output resistance more than it lowers G_m over current here");
    }
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    const auto curves = Curves::simulate();
    if (!curves) return curves.error();
    const auto& c = *curves;
    out.plot("Fig. 61a: transfer curves, outputs open", "V_IN (mV)", "V_OUT (mV)");
    out.plot("Fig. 61b: voltage gain over output voltage", "V_OUT (mV)", "|dV_OUT/dV_IN|").log_y = true;
    for (int k = 0; k < 3; ++k) {
        const char inverter = inverter_letters[k];
        const std::string name = inverter_names[k];
        out.plots[0].add(name, c.coarse.transfer_curve(inverter).scaled(1e3, 1e3));
        out.plots[1].add(name, c.fine.voltage_gain(inverter).scaled(1e3, 1));
        out.claim(name + ": V_Q", c.V_Q(inverter), "V");
        if (inverter == 'c') out.claims.back().published_as(347e-3, "E.4, fig. 61a (-3 mV in fig. 57's terms, errata I16)");
        out.claim(name + ": largest gain", c.largest_gain(inverter), "times");
        out.claim(name + ": output swing for V_IN from rail to rail", c.swing(inverter), "V");
        out.claim(name + ": output range with at least half of the largest gain", c.half_gain_range(inverter), "V");
    }
    out.claim_true("INVB's output swing is smaller than INVA's", c.swing('b') < c.swing('a'),
                   "E.4: INVB's excursion is slightly smaller, by its source degeneration (errata I15)");
    out.claim_true("INVC's V_Q is farther from half the supply than INVA's", std::abs(c.V_Q('c') - 0.35) > std::abs(c.V_Q('a') - 0.35),
                   "E.4: INVC's characteristic curve is slightly displaced");
    auto& down = out.claim_true("INVC's V_Q is below half the supply", c.V_Q('c') < 0.35, "E.4: V_Q is about 347 mV");
    if (down.needs_explanation())
        down.explain(
            "the simulated curve is displaced by less and in the other direction. The displacement is the difference between the division "
            "ratios of the N and P mirrors, for which the thesis has no numbers");
    claim_gains(out, c);
    auto& swing_ratio = out.claim("INVC's swing over INVA's", c.swing('c') / c.swing('a'), "times")
                            .derived_as(1, "E.4: INVC's output excursion is similar to INVA's");
    if (swing_ratio.needs_explanation()) swing_ratio.explain("reason unknown");
    out.plots[0].describe_published("INVB's excursion slightly smaller; INVC's curve slightly displaced, V_Q about 347 mV");
    out.plots[1].describe_published("INVC's gain bigger, its excursion like INVA's");
    return options.report_progress(0.9) ? Result<StudyResult>(out) : options.report_progress(0.9).error();
}

const Study study{
    "fig61", "Transfer curves and voltage gain",
    "INVB's excursion is smaller than INVA's; INVC's V_Q is 347 mV, with a larger gain and INVA's excursion. Thesis E.4, fig. 61", compute};

}  // namespace corpuscle::studies::fig61
