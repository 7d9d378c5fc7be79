// Leakage of the switches over temperature, compared with the membrane's own leak I_LEAK. The leakage limits the temperature
// at which a chip still fires.

#include <fmt/format.h>
#include <algorithm>

#include "reproduction/claims/studies.hpp"
#include "reproduction/claims/study_netlist.hpp"

namespace corpuscle::studies::leakage {

constexpr double I_LEAK_SA = 7e-12, I_LEAK_FA = 10e-12;  // A, of the chips as intended

/// One P and one N switch with V_GS = 0 and half the supply across them; and SA-I's oscillator, switches included, with its membrane held.
constexpr auto netlist = R"(Leakage of switches over temperature
.lib '../process/tsmc180.lib' tt
.include 'parts/trigger.inc'
.include 'parts/oscillator.inc'
.param hv=0
vdd vdd 0 0.7
vp dp 0 0.35
mp5 dp vdd vdd vdd pch w=6u l=0.5u m=2 delvto={hv}
vn dn 0 0.35
mn6 dn 0 0 0 nch w=1.5u l=0.5u m=2 delvto={hv}
* above V_H the trigger has only one state
x u s gl gc vdd oscillator hv_switch={hv}
ilk gl 0 7p
ich gc 0 1n
vu u 0 0.5
.dc temp -55 125 5
)";

struct LeakageCurrents {
    StudyCurve P, N, membrane;  ///< A over degrees C: of one P switch, of one N switch, and the total that pulls SA-I's membrane up
};
/// high_threshold: with switches of a threshold 150 mV higher.
Result<LeakageCurrents> simulate_leakage(bool high_threshold) {
    const auto found = run_study_netlist({netlist, {high_threshold ? "hv=0.15" : "hv=0"}});
    if (!found) return found.error();
    return LeakageCurrents{found->curve("dc", "i(vp)").absolute(), found->curve("dc", "i(vn)").absolute(),
                           found->curve("dc", "i(vu)").absolute()};
}

/// I_A (A) over the temperature under a constant 4 N: the only component of SA-I's current at the end of the plateau.
Result<StudyCurve> simulate_static_current() {
    const auto found = run_study_netlist({"asp_sa1", {"vforce=4"}, ".dc temp -55 125 5"});
    if (!found) return found.error();
    return found->curve("dc", "i(via)");
}

/// Net current (A) that discharges SA-I's membrane at the end of the plateau: I_A, minus the current that pulls the membrane up, minus the
/// leakage of M5A in both rectifiers, which their closed switches pass on to the membrane.
StudyCurve net_current(const StudyCurve& I_A, const LeakageCurrents& leakage) {
    StudyCurve out = I_A;
    for (std::size_t k = 0; k < out.x.size(); ++k) out.y[k] -= leakage.membrane.at(out.x[k]) + 2 * leakage.P.at(out.x[k]);
    return out;
}

void add_claims(const std::string& name, const LeakageCurrents& leakage, const StudyCurve& I_A, StudyResult& out) {
    out.claim(name + ": leakage of a P switch (2x1, 6 um) at 27 C", leakage.P.at(27), "A");
    out.claim(name + ": leakage of an N switch (2x1, 1.5 um) at 27 C", leakage.N.at(27), "A");
    out.claim(name + ": leakage of the P switch at 37 C over that at 27 C", leakage.P.at(37) / leakage.P.at(27), "times");
    out.claim(name + ": leakage of the P switch reaches SA-I's I_LEAK of 7 pA at", leakage.P.crossing(I_LEAK_SA), "C");
    out.claim(name + ": leakage of the P switch reaches FA-I's I_LEAK of 10 pA at", leakage.P.crossing(I_LEAK_FA), "C");
    out.claim(name + ": I_A at 4 N no longer exceeds the current that pulls up, so SA-I's plateau response ends, at",
              net_current(I_A, leakage).crossing(0), "C");
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    const auto standard = simulate_leakage(false), high_threshold = simulate_leakage(true);
    if (!standard) return standard.error();
    if (!high_threshold) return high_threshold.error();
    const auto I_A = simulate_static_current();
    if (!I_A) return I_A.error();
    if (auto ok = options.report_progress(0.9); !ok) return ok.error();
    add_claims("as printed", *standard, *I_A, out), add_claims("hv_switches=1", *high_threshold, *I_A, out);
    auto& leakage_claim = out.claim_true("at 27 C the leakage of a switch is below a tenth of the published I_LEAK of 5 pA",
                                         standard->P.at(27) < 0.5e-12, "thesis 4.4: the membrane's leak is I_LEAK only");
    if (leakage_claim.needs_explanation())
        leakage_claim.explain(
            "table 9's switches are 2x1 with a threshold of 0.45 V in our process card. Either the foundry's transistors leak less or the "
            "switches are of another type; the thesis does not say");
    out.claim_true("at 27 C the leakage of a high-threshold switch is below a tenth of the published I_LEAK of 5 pA",
                   high_threshold->P.at(27) < 0.5e-12, "thesis 4.4: the membrane's leak is I_LEAK only");
    auto& p = out.plot("Currents that pull up a membrane, over temperature", "temperature (C)", "pA");
    p.add("P switch, off", standard->P.scaled(1, 1e12)).add("P switch of high threshold, off", high_threshold->P.scaled(1, 1e12));
    p.add("N switch, off", standard->N.scaled(1, 1e12));
    p.add("total current that pulls up SA-I's membrane", standard->membrane.scaled(1, 1e12))
        .add("total current that pulls up SA-I's membrane, hv_switches=1", high_threshold->membrane.scaled(1, 1e12));
    p.add("SA-I's I_A at 4 N", I_A->scaled(1, 1e12)), p.log_y = true;
    out.note(
        "M5B connects the charged node of M2B to the membrane; M5A of each rectifier connects the supply to the rectifier's output. Both "
        "leakage currents oppose the current that the force sinks from the membrane. The study range finds the temperature limits of the "
        "chips.");
    out.note(
        "With hv_switches=1 the remaining leakage is M1B's own: its 2x4 array at V_GS = 0 leaks more than I_LEAK at high temperature.");
    return out;
}

const Study study{"leakage", "Leakage of switches that are off",
                  "Does the leakage of the switches matter compared with I_LEAK, and from which temperature? Thesis 4.4, table 9", compute};

}  // namespace corpuscle::studies::leakage
