// The high-pass filters' transconductor, INVC tied to itself, and the corners that it makes with 0.8 and 8.8 pF: fig. 30.

#include <fmt/format.h>
#include <cmath>
#include <numbers>

#include "study/deck.hpp"
#include "study/studies.hpp"
#include "study/thesis/load.hpp"

namespace corpuscle::studies::fig30 {

constexpr auto source = "thesis 4.3.1, fig. 30";
constexpr double C_B = 0.8e-12, C_C = 8.8e-12;  // F, table 5's text, errata S4

struct Loads {
    Load b, c;  ///< INVB and INVC
    double times() const { return c.most / b.most; }
};
Result<Loads> loads_in(const circuit::Values& of_models = {}) {
    const auto found = found_in({"invc", {}, ".dc vin 0 0.7 0.5m", of_models});
    if (!found) return found.error();
    // INVB's output is held at half the supply as well as its input, so that the load's own curve is the one of invb.cir
    const auto b = found_in({"invb", {}, ".dc vin 0 0.7 0.5m", of_models});
    if (!b) return b.error();
    return Loads{load_of(b->line("dc", "i(vin)").times(1, -1)), load_of(found->line("dc", "i(vl)"))};
}

struct Corners {
    double B, C, alone_B, alone_C, top_B, top_C;  ///< Hz; alone: G / (2 pi C), far below them; top: of the signal far above
};
Result<Corners> corners_in(const std::vector<std::string>& settings = {}) {
    const auto found = found_in({"high_pass", settings,
                                 ".ac dec 50 1m 10k\n.meas ac f_b when vp(hpb)=0.785398\n.meas ac f_c when vp(hpc)=0.785398\n"
                                 ".meas ac low_b find vm(hpb) at=1m\n.meas ac low_c find vm(hpc) at=1m\n"
                                 ".meas ac top_b max vm(hpb)\n.meas ac top_c max vm(hpc)"});
    if (!found) return found.error();
    return Corners{found->number("f_b"),          found->number("f_c"),   1e-3 / found->number("low_b"),
                   1e-3 / found->number("low_c"), found->number("top_b"), found->number("top_c")};
}

/// How far INVC's resistance, as a share of its largest, is from INVB's between two voltages.
double apart(const Loads& loads, double from, double to) {
    double most = 0;
    const auto c = loads.c.resistance.between(from, to);
    for (std::size_t k = 0; k < c.x.size(); ++k)
        most = std::max(most, std::abs(c.y[k] / loads.c.most - loads.b.resistance.at(c.x[k]) / loads.b.most));
    return most;
}

void tell(const Loads& loads, const Loads& ideal, Outcome& out) {
    const auto why = fmt::format(
        "by ratios its mirrors divide by 288 x 64 = 18432 (eq. 38, 39; errata S7b), without length modulation ours divide by {:.0f}; with "
        "it "
        "the mirrors' diodes bear more voltage than the arrays in series, and the currents are divided by more. The foundry's divide by "
        "less "
        "than the ratios: why is not known",
        ideal.times());
    out.claim("largest resistance", loads.c.most, "ohm").printed_as(6.6e9, source).because(why);
    out.claim("times INVB's", loads.times(), "times").printed_as(16000, source).because(why);
    out.claim("without length modulation: times INVB's", ideal.times(), "times").held_to(18432, "eq. 38 and 39, errata S7b");
    out.claim("nothing flows in at", loads.c.rest, "V").held_to(350e-3, "thesis 4.3.1: the same shape as fig. 28a");
    out.claim("largest resistance at", loads.c.at, "V").held_to(350e-3, "thesis 4.3.1: the same shape as fig. 28b");
    out.claim("its resistance as a share of the largest, beside INVB's, 200 to 500 mV: farthest apart", apart(loads, 0.2, 0.5))
        .at_most(0.1, "thesis 4.3.1: \"a similar shape\"; a tenth is set here");
}

void tell(const Corners& f, Outcome& out) {
    const double beside = C_B * (f.alone_B / f.B - 1);
    const auto why = fmt::format(
        "INVC's resistance is larger than the printed, and what its node has besides stands beside the capacitor: {:.2g} pF of filter B, "
        "by its "
        "corner with and without",
        1e12 * beside);
    out.claim("corner of filter B", f.B, "Hz").printed_as(30, source).because(why);
    out.claim("corner of filter C", f.C, "Hz").printed_as(2.7, source).because(why);
    out.claim("... of the capacitor alone, G_m / 2 pi C: B", f.alone_B, "Hz").printed_as(30, source).because("INVC's resistance");
    out.claim("... C", f.alone_C, "Hz").printed_as(2.7, source).because("INVC's resistance");
    out.claim("with the printed 6.6 Gohm and the capacitor alone: B", 1 / (2 * std::numbers::pi * 6.6e9 * C_B), "Hz")
        .printed_as(30, source);
    out.claim("... C", 1 / (2 * std::numbers::pi * 6.6e9 * C_C), "Hz").printed_as(2.7, source);
    out.claim("filter B's node has besides its capacitor", beside, "F");
    out.claim("so that of its signal is lost, far above the corner: B", 100 * (1 - f.top_B), "%");
    out.claim("... C", 100 * (1 - f.top_C), "%");
}

Result<Outcome> work(const StudyOptions& options) {
    Outcome out;
    const auto loads = loads_in(), ideal = loads_in(ideal_mirrors);
    if (!loads) return loads.error();
    if (!ideal) return ideal.error();
    const auto f = corners_in(), pico = corners_in({"cb=800p"});
    if (!f) return f.error();
    if (!pico) return pico.error();
    if (auto ok = options.at(0.9); !ok) return ok.error();
    tell(*loads, *ideal, out);
    tell(*f, out);
    out.claim("with the printed 800 pF: corner of filter B", pico->B, "Hz")
        .printed_as(30, source)
        .because("\"800 pF\" is 800 fF: 20 x 20 um at 2 fF/um^2, and eleven of them are the 8.8 pF of the same sentence (errata S4)");
    out.plot("30a, input current over input voltage", "V_IN (mV)", "current (pA)")
        .shape("as 28a, in picoamperes")
        .add("into INVC as a load", loads->c.current.times(1e3, 1e12));
    out.plot("30b, resistance over input voltage", "V_IN (mV)", "resistance (Gohm)")
        .shape("at most 6.6 Gohm")
        .add("INVC as a load", loads->c.resistance.between(0.1, 0.6).times(1e3, 1e-9))
        .add("INVB as a load, times 16000", loads->b.resistance.between(0.1, 0.6).times(1e3, 16000e-9))
        .points("printed", {{350}, {6.6}});
    return out;
}

const Study study{"fig30", "The high-pass filters' transconductor and their corners",
                  "6.6 Gohm, 16000 times the other transconductor; corners at 30 and 2.7 Hz. Thesis 4.3.1, fig. 30", work};

}  // namespace corpuscle::studies::fig30
