// Fig. 55: the bias generator along temperature.

#include <cmath>

#include "study/studies.hpp"
#include "study/thesis/bias_figure.hpp"

namespace corpuscle::studies::fig55 {

constexpr BiasFigure figure{BiasAxis::temperature, "55", "temperature (C)", "C", 1, {-55, 95}, {Claim::none, Claim::none}};

/// How far I_Q goes from what is asked for, of it.
double worst(const BiasCorner& c) { return c.sweep.miss_of_current().most() * bias_current_margin; }

Result<Outcome> work(const StudyOptions& options) {
    Outcome out;
    const auto corners = make(figure, out, options);
    if (!corners) return corners.error();
    const auto& c = *corners;
    out.finds("V_BN falls as it gets warmer", c[0].sweep.line("v(bn)").slope().most() < 0, "E.2: V_T decreases, V_BP and V_BN compensate");
    out.finds("V_BP rises, so that the body is lifted less", c[0].sweep.line("v(bp)").slope().least() > 0, "E.2: as above");
    for (const auto& corner : c) out.claim(std::string(corner.name) + ": I_Q at worst off by", 100 * worst(corner), "%");
    out.finds("I_Q strays farthest in the FF corner", worst(c[2]) > worst(c[1]) && worst(c[2]) > worst(c[0]),
              "E.2: in special for the FF corner");
    out.claim("FF: works to", c[2].works.to, "C");
    out.claim("SS: works from", c[1].works.from, "C");
    out.note("I_BIAS is not said; it is 200 nA here, as in table 18. E.2 says voltages between -55 and 95 C for temperatures (errata I8).");
    out.plots[0].shape("V_BN and V_BP follow V_T; -55 to 125 C at 0.7 V, typical");
    out.plots[1].shape("I_Q depends on the corner, in special FF");
    return out;
}

const Study study{"fig55", "The bias generator along temperature",
                  "It works from -55 to 95 C typically; in the FF corner it corrects I_Q worse. Thesis E.2, fig. 55 (errata I7, I8)", work};

}  // namespace corpuscle::studies::fig55
