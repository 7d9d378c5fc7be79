// The loop of a high-pass filter: INVC tied to itself behind its capacitor. "Inherently stable" (E.4): its gain, its phase margin.

#include <fmt/format.h>
#include <cmath>
#include <numbers>

#include "study/deck.hpp"
#include "study/studies.hpp"

namespace corpuscle::studies::invc_loop {

constexpr auto source = "thesis E.4";

/// Opened to small signals, closed at rest; at its end the capacitor, and a second cell for what the first one's input loads it with.
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
    Line dB, phase;                    ///< phase: degrees above -180 of the loop that is fed back
    double gain, unity, margin, turn;  ///< dB, Hz, degrees, Hz: where the phase is used up
    double spare;                      ///< dB below unity there
    double inner;                      ///< Hz: 45 degrees more than the outer pole's 90
};
Result<Loop> loop_with(double farad) {
    const auto found = found_in({opened, {fmt::format("c_hp={}", farad)}});
    if (!found) return found.error();
    const auto degrees = found->line("ac", "vp(out)").times(1, 180 / std::numbers::pi);
    Loop out{found->line("ac", "vdb(out)"), degrees, 0, 0, 0, 0, 0, 0};
    for (double& p : out.phase.y)
        if (p < -90) p += 360;  // -180 is 180
    out.gain = out.dB.y[0], out.unity = out.dB.where(0), out.margin = out.phase.at(out.unity);
    out.turn = out.phase.where(0, out.unity), out.spare = -out.dB.at(out.turn), out.inner = out.phase.where(45, out.unity);
    return out;
}

void tell(const std::string& name, const Loop& loop, Outcome& out) {
    out.claim(name + ": the loop's gain is one at", loop.unity, "Hz");
    out.claim(name + ": phase margin", loop.margin, "degrees").at_least(60, "thesis E.4: inherently stable; 60 degrees are set here");
    out.claim(name + ": gain margin", loop.spare, "dB").at_least(20, "thesis E.4: inherently stable; 20 dB are set here");
    out.claim(name + ": the inner nodes' poles, over it", loop.inner / loop.unity, "times")
        .at_least(10, "thesis E.4: its output's impedance is very large beside the inner nodes'; ten times is set here");
}

Result<Outcome> work(const StudyOptions& options) {
    Outcome out;
    auto& gain = out.plot("Gain of the loop", "frequency (Hz)", "dB");
    gain.log_x = true;
    Plot phase{"Phase left before it is -180 degrees", "frequency (Hz)", "degrees", {}, true};
    for (const auto& [name, farad] : {std::pair{"filter B, 0.8 pF", 0.8e-12}, {"filter C, 8.8 pF", 8.8e-12}, {"no capacitor", 1e-18}}) {
        const auto loop = loop_with(farad);
        if (!loop) return loop.error();
        if (farad == 0.8e-12) {
            out.claim("the loop's gain at 0.1 mHz", loop->gain, "dB");
            out.finds("it inverts: three times in all", std::abs(loop->phase.y[0] - 180) < 5, source);
        }
        tell(name, *loop, out);
        gain.add(name, loop->dB.between(0.1, 1e5)), phase.add(name, loop->phase.between(0.1, 1e5));
        if (auto ok = options.at(0.3); !ok) return ok.error();
    }
    out.plots.push_back(std::move(phase));
    out.note(
        "The loop is opened between output and input by an inductance that closes it at rest; margins are of the loop as the filter has "
        "it, whose "
        "capacitor makes the outer pole. Nothing but a first-order fall is left up to a hundred times the corner.");
    return out;
}

const Study study{"invc-loop", "Is the ultra-low transconductor's loop stable?",
                  "Inverted only three times, with one large impedance at its output, it is inherently stable. Thesis 4.3.1, E.4", work};

}  // namespace corpuscle::studies::invc_loop
