// Fig. 55: the bias generator over temperature.
// Symbols. V_BN and V_BP are the body voltages that the generator sets, V_REF is half the supply, V_Q and I_Q are voltage and current of
// the replica, an inverter with its output tied to its input.

#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/bias/bias_figure.hpp"

namespace corpuscle::studies::fig55 {

constexpr BiasFigure figure{BiasAxis::temperature, "55", "temperature (C)", "C", 1, {-55, 95}, {Claim::none, Claim::none}, -55};

/// Largest relative error of I_Q from -55 to 125 C, as in the figure, as a fraction of I_BIAS.
double largest_error(const BiasCorner& c) { return c.sweep.current_error().between(-55, 125).max() * bias_current_margin; }

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    const auto corners = TRY(simulate_bias_figure(figure, out, options));
    const auto& c = corners;  // tt, ss, ff
    out.claim_true("V_BN falls as the temperature rises", c[0].sweep.curve("v(bn)").slope().max() < 0,
                   "E.2: V_T decreases, V_BP and V_BN compensate");
    out.claim_true("V_BP rises with the temperature, so the body bias decreases", c[0].sweep.curve("v(bp)").slope().min() > 0,
                   "E.2: V_T decreases, V_BP and V_BN compensate");
    for (const auto& corner : c) out.claim(std::string(corner.name) + ": largest error of I_Q", 100 * largest_error(corner), "%");
    out.claim_true("the error of I_Q is largest in the FF corner",
                   largest_error(c[2]) > largest_error(c[1]) && largest_error(c[2]) > largest_error(c[0]),
                   "E.2: \"in special for the FF corner\"");
    out.claim("FF: works to", c[2].working_range.to, "C");
    out.claim("SS: works from", c[1].working_range.from, "C");
    out.note(
        "I_BIAS is not given; it is 200 nA here, as in table 18. E.2 prints voltages where it means temperatures between -55 and 95 C "
        "(errata I8).");
    out.plots[0].describe_published("V_BN and V_BP follow V_T; -55 to 125 C at 0.7 V, typical");
    out.plots[1].describe_published("I_Q depends on the corner, especially FF");
    return out;
}

const Study study{"fig55", "The bias generator over temperature",
                  "It works from -55 to 95 C typically; in the FF corner it corrects I_Q less well. Thesis E.2, fig. 55 (errata I7, I8)",
                  ClaimKind::predicted, compute};

}  // namespace corpuscle::studies::fig55
