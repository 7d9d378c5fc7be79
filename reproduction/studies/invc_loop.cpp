// The feedback loop of a high-pass filter, a capacitor in series with an INVC whose output is tied to its input. E.4 calls the loop
// "inherently stable". Computes its gain and its phase margin.

#include <fmt/format.h>
#include <cmath>
#include <numbers>

#include "reproduction/claims/studies.hpp"
#include "reproduction/claims/study_netlist.hpp"

namespace corpuscle::studies::invc_loop {

constexpr auto source = "thesis E.4";

/// The loop is open for small signals and closed for the operating point. Its end carries the capacitor and a second cell, whose input is
/// the same load as that of the first cell.
constexpr auto opened = R"(INVC's loop, opened
.lib '../process/tsmc180.lib' tt
.include 'parts/transconductor.inc'
.param c_hp=0.8p
vdd vdd 0 0.7
ibias gp 0 200n
xbias vdd gp bp bn bias
vin drive 0 dc 0 ac 1
cin drive in 1
lrest out in 1e18
x in out gp1 gn1 vdd bp bn invc
ch out 0 {c_hp}
xnext out next gp2 gn2 vdd bp bn invc
vnext next 0 0.35
.ac dec 40 100u 100meg
)";

struct Loop {
    // Over frequency, Hz. dB: gain of the open loop. phase: that of the return ratio plus 180 degrees, which at `unity` is the phase
    // margin.
    StudyCurve dB, phase;
    double gain;                    ///< dB, at 0.1 mHz
    double unity, phase_crossover;  ///< Hz, where the gain is 1, and where `phase` is 0
    double margin;                  ///< degrees: `phase` at unity
    double gain_margin;             ///< dB: how far the gain is below 1 at phase_crossover
    double inner;                   ///< Hz: where the poles of the inner nodes add 45 degrees of lag to the 90 degrees of the outer pole
};

/// The loop with this capacitor of the filter.
Result<Loop> loop_with(double farad) {
    const auto found = run_study_netlist({opened, {fmt::format("c_hp={}", farad)}});
    if (!found) return found.error();
    const auto degrees = found->curve("ac", "vp(out)").scaled(1, 180 / std::numbers::pi);
    Loop out{found->curve("ac", "vdb(out)"), degrees, 0, 0, 0, 0, 0, 0};
    for (double& p : out.phase.y)
        if (p < -90) p += 360;  // -180 degrees is the same as 180
    out.gain = out.dB.y[0], out.unity = out.dB.crossing(0), out.margin = out.phase.at(out.unity);
    out.phase_crossover = out.phase.crossing(0, out.unity), out.gain_margin = -out.dB.at(out.phase_crossover),
    out.inner = out.phase.crossing(45, out.unity);
    return out;
}

void add_claims(const std::string& name, const Loop& loop, StudyResult& out) {
    out.claim(name + ": unity-gain frequency of the loop", loop.unity, "Hz");
    out.claim(name + ": phase margin", loop.margin, "degrees").allow_min(60, "thesis E.4: inherently stable; 60 degrees is our choice");
    out.claim(name + ": gain margin", loop.gain_margin, "dB").allow_min(20, "thesis E.4: inherently stable; 20 dB is our choice");
    out.claim(name + ": poles of the inner nodes over the unity-gain frequency", loop.inner / loop.unity, "times")
        .allow_min(10, "thesis E.4: INVC's output impedance is very large compared with the inner nodes'; ten times is our choice");
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    auto& gain = out.plot("Gain of the loop", "frequency (Hz)", "dB");
    gain.log_x = true;
    StudyPlot phase{"Phase of the loop; the margin is its value at gain 1", "frequency (Hz)", "degrees", {}, true};
    for (const auto& [name, farad] : {std::pair{"filter B, 0.8 pF", 0.8e-12}, {"filter C, 8.8 pF", 8.8e-12}, {"no capacitor", 1e-18}}) {
        const auto loop = loop_with(farad);
        if (!loop) return loop.error();
        if (farad == 0.8e-12) {
            out.claim("loop gain at 0.1 mHz", loop->gain, "dB");
            out.claim_true("the loop inverts: three inversions in all", std::abs(loop->phase.y[0] - 180) < 5, source);
        }
        add_claims(name, *loop, out);
        gain.add(name, loop->dB.between(0.1, 1e5)), phase.add(name, loop->phase.between(0.1, 1e5));
        if (auto ok = options.report_progress(0.3); !ok) return ok.error();
    }
    out.plots.push_back(std::move(phase));
    out.note(
        "An inductance between output and input opens the loop for small signals and closes it for the operating point. The margins are "
        "those of the filter, whose capacitor makes the outer pole. Up to a hundred times the unity-gain frequency the loop's gain "
        "has only a first-order roll-off.");
    return out;
}

const Study study{"invc-loop", "Is the ultra-low transconductor's loop stable?",
                  "With only three inversions and one large impedance, at its output, it is inherently stable. Thesis 4.3.1, E.4", compute};

}  // namespace corpuscle::studies::invc_loop
