// Fig. 58: the same as fig. 57, each by its transconductance at V_IN = 0.

#include <fmt/format.h>
#include <cmath>

#include "study/studies.hpp"
#include "study/thesis/inverters.hpp"

namespace corpuscle::studies::fig58 {

Line normalised(const Line& line, double by) { return line.times(1, 1 / by); }

/// How far from 1 a normalised transconductance goes within so much of V_IN = 0.
double strays(const Line& G, double within) {
    const auto part = G.between(-within, within);
    return std::max(part.most() - 1, 1 - part.least());
}

Result<Outcome> work(const StudyOptions& options) {
    Outcome out;
    const auto usual = Inverters::swept(2e-3), more = Inverters::swept(2e-3, 0.8);
    for (const auto* s : {&usual, &more})
        if (!*s) return s->error();
    out.plot("Fig. 58a: output current by G_m(0)", "V_IN (mV)", "I_o / G_m(0) (mV)");
    out.plot("Fig. 58b: transconductance by its value at 0", "V_IN (mV)", "G_m / G_m(0)");
    Line G[2];
    for (int k = 0; k < 2; ++k) {
        const char which = inverter_letters[k];
        G[k] = normalised(usual->transconductance(which), usual->at_rest(which));
        out.plots[0].add(inverter_names[k], normalised(usual->current(which), usual->at_rest(which)).times(1e3, 1e3));
        out.plots[1].add(inverter_names[k], G[k].times(1e3, 1));
    }
    out.plots[0].add("straight", {{-350, 350}, {350, -350}}).shape("INVB's is the straighter one");
    out.plots[1].shape("INVA's is symmetrical but highly non-linear, INVB's still non-linear, but better");
    for (const double within : {0.1, 0.2, 0.34}) {
        for (int k = 0; k < 2; ++k)
            out.claim(fmt::format("{}: G_m strays from its value at 0 within {:g} mV by", inverter_names[k], 1e3 * within),
                      100 * strays(G[k], within), "%");
        out.finds(fmt::format("INVB's strays less within {:g} mV", 1e3 * within), strays(G[1], within) < strays(G[0], within),
                  "E.3: INVB is still non-linear, but better");
    }
    const auto G_more = normalised(more->transconductance('b'), more->at_rest('b'));
    out.finds("INVB at 0.8 V strays less within 200 mV than at 0.7 V", strays(G_more, 0.2) < strays(G[1], 0.2),
              "E.3: even better results with higher supply voltages");
    out.claim("INVB at 0.8 V: its transconductance over that at 0.7 V", more->at_rest('b') / usual->at_rest('b'), "times")
        .at_least(1, "E.3: the transconductance would also increase accordingly");
    if (auto& last = out.claims.back(); last.needs_reason())
        last.because("the bias generator holds 200 nA at any supply, and with it the transconductance");
    return options.at(0.9) ? Result<Outcome>(out) : options.at(0.9).error();
}

const Study study{
    "fig58", "The same, normalised",
    "INVB's normalised transconductance is still non-linear, but better than INVA's; better yet with a higher supply. Thesis E.3, fig. 58",
    work};

}  // namespace corpuscle::studies::fig58
