// Fig. 61: characteristic curves and voltage gains of the three inverters, outputs open.

#include <fmt/format.h>
#include <cmath>

#include "study/studies.hpp"
#include "study/thesis/inverters.hpp"

namespace corpuscle::studies::fig61 {

/// Coarse over all of V_IN, fine where the outputs fall.
struct Curves {
    Inverters coarse, fine;
    static Result<Curves> swept() {
        auto coarse = Inverters::swept(2e-3);
        if (!coarse) return coarse.error();
        auto fine = Inverters::ordered(".dc vin 0.34 0.36 20u");
        if (!fine) return fine.error();
        return Curves{std::move(*coarse), std::move(*fine)};
    }
    double V_Q(char which) const {  // over V_SS
        auto miss = fine.characteristic(which);
        for (std::size_t k = 0; k < miss.x.size(); ++k) miss.y[k] -= miss.x[k];
        return 0.35 + miss.where(0);
    }
    double swing(char which) const {
        const auto curve = coarse.characteristic(which);
        return curve.most() - curve.least();
    }
    double most_gain(char which) const { return fine.gain(which).most(); }
    /// Of outputs, the range where the gain is at least half of its largest, V.
    double excursion(char which) const {
        const auto gain = fine.gain(which);
        const double half = 0.5 * gain.most();
        double from = Claim::none, to = Claim::none;
        for (std::size_t k = 0; k < gain.x.size(); ++k)
            if (gain.y[k] >= half) (from == from ? to : from) = gain.x[k];
        return to - from;
    }
};

/// A gain is G_m / I times half an Early voltage, and the card's arrays of eight units have one Early voltage whatever they carry.
void claim_gains(Outcome& out, const Curves& c) {
    const auto per_current = [&](char input, double branch) { return c.coarse.at_rest(input) / branch; };
    const double of_A = per_current('a', c.coarse.taken('a').at(0)), of_C = per_current('b', 0.5 * c.coarse.taken('b').at(0));
    out.claim("INVA: G_m over the current of a branch", of_A, "1/V");
    out.claim("INVC: the same of its INVB, in each of the two branches that are mirrored", of_C, "1/V");
    for (const char which : {'b', 'a'}) {
        const auto than = fmt::format("INVC's gain is larger than {}'s", inverter_names[which - 'a']);
        auto& claim =
            out.finds(than, c.most_gain('c') > c.most_gain(which), "E.4: INVC voltage gain is also bigger; than whose is not said");
        if (claim.needs_reason())
            claim.because(which == 'a'
                              ? "its G_m over current is smaller for the degeneration, and the card gives its output the same Early "
                                "voltage as INVA's; that the foundry's have a longer one at picoamperes would explain it, but is not known"
                              : "degeneration lifts INVB's output resistance more than it lowers G_m over current here; as above");
    }
}

Result<Outcome> work(const StudyOptions& options) {
    Outcome out;
    const auto made = Curves::swept();
    if (!made) return made.error();
    const auto& c = *made;
    out.plot("Fig. 61a: characteristic curves, outputs open", "V_IN (mV)", "V_OUT (mV)");
    out.plot("Fig. 61b: voltage gain over output voltage", "V_OUT (mV)", "|dV_OUT/dV_IN|").log_y = true;
    for (int k = 0; k < 3; ++k) {
        const char which = inverter_letters[k];
        const std::string name = inverter_names[k];
        out.plots[0].add(name, c.coarse.characteristic(which).times(1e3, 1e3));
        out.plots[1].add(name, c.fine.gain(which).times(1e3, 1));
        out.claim(name + ": V_Q", c.V_Q(which), "V");
        if (which == 'c') out.claims.back().printed_as(347e-3, "E.4, fig. 61a (-3 mV in fig. 57's terms, errata I16)");
        out.claim(name + ": largest gain", c.most_gain(which), "times");
        out.claim(name + ": swing of the output, rail to rail of V_IN", c.swing(which), "V");
        out.claim(name + ": outputs with at least half of that gain", c.excursion(which), "V");
    }
    out.finds("INVB's output excursion is smaller than INVA's", c.swing('b') < c.swing('a'),
              "E.4: slightly smaller, by its source degeneration (errata I15)");
    out.finds("INVC is displaced more than INVA", std::abs(c.V_Q('c') - 0.35) > std::abs(c.V_Q('a') - 0.35),
              "E.4: INVC's characteristic curve is slightly displaced");
    auto& down = out.finds("it is displaced downwards", c.V_Q('c') < 0.35, "E.4: V_Q is about 347 mV");
    if (down.needs_reason())
        down.because(
            "ours is displaced by less and to the other side: it is the difference of what the N and the P mirrors divide by, for which "
            "the thesis has no numbers");
    claim_gains(out, c);
    auto& same = out.claim("INVC's swing over INVA's", c.swing('c') / c.swing('a'), "times")
                     .held_to(1, "E.4: its output excursion is similar to INVA's");
    if (same.needs_reason()) same.because("why is not known");
    out.plots[0].shape("INVB's excursion slightly smaller; INVC's curve slightly displaced, V_Q about 347 mV");
    out.plots[1].shape("INVC's gain bigger, its excursion like INVA's");
    return options.at(0.9) ? Result<Outcome>(out) : options.at(0.9).error();
}

const Study study{
    "fig61", "Characteristic curves and voltage gain",
    "INVB's excursion is smaller than INVA's; INVC rests at 347 mV, with a larger gain and INVA's excursion. Thesis E.4, fig. 61", work};

}  // namespace corpuscle::studies::fig61
