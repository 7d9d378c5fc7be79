// Fig. 53: the bias generator along its current.

#include "study/studies.hpp"
#include "study/thesis/bias_figure.hpp"

namespace corpuscle::studies::fig53 {

constexpr BiasFigure figure{BiasAxis::current, "53", "I_BIAS (nA)", "A", 1e9, {100e-9, 2e-6}, {100e-9, 700e-9}};

/// Whether both transistors between which BN lies are saturated.
Result<bool> saturated(double I_BIAS) {
    const auto s = bias_state({bias_setting(BiasAxis::current, I_BIAS)});
    if (!s) return s.error();
    return s->V_M3B >= s->needs_M3B && s->V_M4A >= s->needs_M4A;
}

Result<Outcome> work(const StudyOptions& options) {
    Outcome out;
    const auto corners = make(figure, out, options);
    if (!corners) return corners.error();
    const auto& typical = corners->front();
    const auto V_BN = typical.sweep.line("v(bn)");
    const std::string why =
        "V_BN follows from V_T, n and I_SQ of the card, whose V_T is set so that the unbiased inverter carries 17.5 nA as printed; what "
        "thresholds lower by some tens of millivolts would do stands in bias-valid";
    for (const auto& [I, printed] : {std::pair{100e-9, 100e-3}, {2e-6, 600e-3}}) {
        auto& c =
            out.claim(I < 1e-6 ? "typical: V_BN at 100 nA" : "typical: V_BN at 2 uA", V_BN.at(I), "V").printed_as(printed, figure.source());
        if (c.needs_reason()) c.because(why);
    }
    out.finds("V_BN rises with I_BIAS", V_BN.slope().between(20e-9, 2e-6).least() > 0, figure.source());
    const auto inside = saturated(200e-9), below = saturated(0.5 * typical.works.from), above = saturated(2 * typical.works.to);
    for (const auto* s : {&inside, &below, &above})
        if (!*s) return s->error();
    const char* words = "E.2: they are in the range, and in the linear region below and above it";
    out.finds("M3B and M4A are saturated at 200 nA", *inside, words);
    out.finds("one of them is not at half the current at which it begins to work", !*below, words);
    out.finds("one of them is not at twice the current up to which it works", !*above, words);
    out.plots[0].shape("V_BN from 100 to 600 mV over 100 nA to 2 uA");
    out.plots[1].shape("three corners, each with its own range; common to all is 100 to 700 nA");
    return out;
}

const Study study{"fig53", "The bias generator along its current",
                  "It works from 100 nA to 2 uA typically, V_BN from 100 to 600 mV, and from 100 to 700 nA in corners. Thesis E.2, fig. 53",
                  work};

}  // namespace corpuscle::studies::fig53
