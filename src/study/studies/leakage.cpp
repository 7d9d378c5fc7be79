// What the switches let through while they are off, over temperature, beside the membrane's own leak: it decides when a chip goes dumb.

#include <fmt/format.h>
#include <algorithm>

#include "study/deck.hpp"
#include "study/studies.hpp"

namespace corpuscle::studies::leakage {

constexpr double I_LEAK_SA = 7e-12, I_LEAK_FA = 10e-12;  // A, of the chips as intended

/// One P and one N switch with V_GS = 0 and half the supply over them; and an oscillator whose membrane is held, switch and all.
constexpr auto off = R"(Switches that are off, along temperature
.lib '../process/tsmc180.lib' tt
.include 'parts/trigger.inc'
.include 'parts/oscillator.inc'
.param hv=0
vdd vdd 0 0.7
vp dp 0 0.35
mp5 dp vdd vdd vdd pch w=6u l=0.5u m=2 delvto={hv}
vn dn 0 0.35
mn6 dn 0 0 0 nch w=1.5u l=0.5u m=2 delvto={hv}
* above V_H the trigger has one state alone
x u s gl gc vdd oscillator hv_switch={hv}
ilk gl 0 7p
ich gc 0 1n
vu u 0 0.5
.dc temp -55 125 5
)";

struct Leaks {
    Line P, N, membrane;  ///< A over C: a switch each, and all that pulls an SA-I membrane up
};
Result<Leaks> leaks_of(bool better) {
    const auto found = found_in({off, {better ? "hv=0.15" : "hv=0"}});
    if (!found) return found.error();
    return Leaks{found->line("dc", "i(vp)").absolute(), found->line("dc", "i(vn)").absolute(), found->line("dc", "i(vu)").absolute()};
}

/// I_A under a steady 4 N: all that SA-I has at the plateau's end.
Result<Line> static_current() {
    const auto found = found_in({"asp_sa1", {"vforce=4"}, ".dc temp -55 125 5"});
    if (!found) return found.error();
    return found->line("dc", "i(via)");
}

/// What is left at the plateau's end: I_A, less what pulls the membrane up, less the M5A of both rectifiers, whose leak their closed
/// switches pass on.
Line left_of(const Line& I_A, const Leaks& leaks) {
    Line out = I_A;
    for (std::size_t k = 0; k < out.x.size(); ++k) out.y[k] -= leaks.membrane.at(out.x[k]) + 2 * leaks.P.at(out.x[k]);
    return out;
}

void tell(const std::string& name, const Leaks& leaks, const Line& I_A, Outcome& out) {
    out.claim(name + ": a P switch (2x1, 6 um) lets through at 27 C", leaks.P.at(27), "A");
    out.claim(name + ": an N switch (2x1, 1.5 um)", leaks.N.at(27), "A");
    out.claim(name + ": the P switch, ten degrees warmer", leaks.P.at(37) / leaks.P.at(27), "times");
    out.claim(name + ": the P switch lets through SA-I's I_LEAK of 7 pA from", leaks.P.where(I_LEAK_SA), "C");
    out.claim(name + ": ... FA-I's 10 pA from", leaks.P.where(I_LEAK_FA), "C");
    out.claim(name + ": SA-I's I_A at 4 N no more than pulls up, so that its plateau ends, from", left_of(I_A, leaks).where(0), "C");
}

Result<Outcome> work(const StudyOptions& options) {
    Outcome out;
    const auto plain = leaks_of(false), better = leaks_of(true);
    if (!plain) return plain.error();
    if (!better) return better.error();
    const auto I_A = static_current();
    if (!I_A) return I_A.error();
    if (auto ok = options.at(0.9); !ok) return ok.error();
    tell("as printed", *plain, *I_A, out), tell("hv_switches=1", *better, *I_A, out);
    auto& least = out.finds("at 27 C a switch lets through less than a tenth of the printed I_LEAK of 5 pA", plain->P.at(27) < 0.5e-12,
                            "thesis 4.4: the membrane's leak is I_LEAK alone");
    if (least.needs_reason())
        least.because(
            "table 9's switches are 2x1 of 0.45 V with the card of ours; the foundry's leak less or its switches are of another kind: the "
            "thesis does not say");
    out.finds("with switches of the higher threshold it is so", better->P.at(27) < 0.5e-12, "the same");
    auto& p = out.plot("What pulls up a membrane, along temperature", "temperature (C)", "pA");
    p.add("a P switch that is off", plain->P.times(1, 1e12)).add("... of the higher threshold", better->P.times(1, 1e12));
    p.add("an N switch that is off", plain->N.times(1, 1e12));
    p.add("all that pulls up SA-I's membrane", plain->membrane.times(1, 1e12))
        .add("... with hv_switches=1", better->membrane.times(1, 1e12));
    p.add("SA-I's I_A at 4 N", I_A->times(1, 1e12)), p.log_y = true;
    out.note(
        "M5B is between the filled node of M2B and the membrane, M5A of each rectifier between the supply and its output: both pull up, "
        "against "
        "what the force makes sink. Study range finds where the chips themselves end.");
    out.note("With hv_switches=1 what is left is M1B's own, whose 2x4 at V_GS = 0 leaks more than I_LEAK where it is hot.");
    return out;
}

const Study study{"leakage", "What leaks while it is off",
                  "Does what the switches leak matter beside I_LEAK, and from which temperature? Thesis 4.4, table 9", work};

}  // namespace corpuscle::studies::leakage
