// Fig. 54: the bias generator over its supply.
// Symbols. V_BN and V_BP are the body voltages that the generator sets, V_REF is half the supply, V_Q and I_Q are voltage and current of
// the replica, an inverter with its output tied to its input.

#include <algorithm>
#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/bias/bias_figure.hpp"

namespace corpuscle::studies::fig54 {

constexpr BiasFigure figure{BiasAxis::supply, "54", "V_DD (V)", "V", 1, {550e-3, 800e-3}, {650e-3, 750e-3}};

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    const auto corners = TRY(simulate_bias_figure(figure, out, options));
    const auto& typical = corners.front();
    double largest_error = 0;  // of V_REF, as a fraction of the supply
    const auto V_REF = typical.sweep.curve("v(ref)");
    for (std::size_t k = 0; k < V_REF.x.size(); ++k) largest_error = std::max(largest_error, std::abs(V_REF.y[k] / V_REF.x[k] - 0.5));
    out.claim_true("V_REF is half the supply within a thousandth of the supply, from 0.4 to 0.9 V", largest_error < 1e-3, "thesis E.2");
    out.claims.back().of_kind(ClaimKind::identity);
    const auto from = typical.working_range.from, to = typical.working_range.to;
    out.claim_true("V_BP rises with the supply", typical.sweep.curve("v(bp)").between(from, to).slope().min() > 0,
                   "E.2: as V_DD increases, so do V_REF, V_BP and V_BN");
    out.claim_true("V_BN falls as the supply rises", typical.sweep.curve("v(bn)").between(from, to).slope().max() < 0,
                   "follows from E.2: V_REF drives M4A, whose current is constant, so its bulk needs less bias");
    out.note(
        "I_BIAS is not given; it is 200 nA here, as in table 18. The text can also be read as V_BN rising with the supply, which would "
        "contradict the circuit: BN comes closer to its rail, as BP does to its own.");
    out.plots[0].describe_published("V_DD from 400 to 900 mV, typical, at room temperature");
    out.plots[1].describe_published("the corners limit the supply range severely");
    return out;
}

const Study study{"fig54", "The bias generator over its supply",
                  "It works from 550 to 800 mV typically, from 650 to 750 mV in all corners. Thesis E.2, fig. 54 (errata I7)",
                  ClaimKind::predicted, compute};

}  // namespace corpuscle::studies::fig54
