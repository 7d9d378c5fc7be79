// Stability of the transducer's loop from no force to ten times the stimulus. The loop is opened at the amplifier's inverting input
// (circuits/transducer_loop.cir), with and without a capacitance at the sensor.

#include <fmt/format.h>
#include <cmath>
#include <numbers>

#include "reproduction/claims/studies.hpp"
#include "reproduction/claims/study_netlist.hpp"

namespace corpuscle::studies::transducer_loop {

/// The loop's gain at 10 Hz and its phase margin over the force, for possible capacitances of the sensor and its wire.
struct Loops {
    static constexpr const char* capacitances[] = {"1f", "10p", "100p"};  ///< F; 1 fF stands for none
    StudyCurve gain, margins[3];  ///< over the force (N): dB without capacitance; degrees, for each capacitance

    static std::string description(std::size_t k) {
        return k == 0 ? "without capacitance" : fmt::format("with {}F at the sensor", capacitances[k]);
    }
    /// Simulates the loop at a force and appends the results.
    Result<void> add(double newtons) {
        std::string directives;
        for (std::size_t k = 0; k < 3; ++k)
            directives += fmt::format("xf{0} f{0} vdd vy opened force={1}\nc{0} f{0} 0 {2}\n", k, newtons, capacitances[k]);
        const auto found = run_study_netlist({"transducer_loop", {}, directives + ".ac dec 20 10 10meg"});
        if (!found) return found.error();
        gain.x.push_back(newtons), gain.y.push_back(20 * std::log10(found->curve("ac", "vm(f0)").at(10)));
        for (std::size_t k = 0; k < 3; ++k) {
            const double f = found->curve("ac", fmt::format("vm(f{})", k)).crossing(1);
            // the loop is opened at the inverting input, so the phase itself, at gain 1, is the margin
            const auto angle = found->curve("ac", fmt::format("vp(f{})", k));
            if (f == f) margins[k].x.push_back(newtons), margins[k].y.push_back(angle.at(f) * 180 / std::numbers::pi);
        }
        return {};
    }
};

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    Loops loops;
    for (const double newtons : {0.02, 0.05, 0.2, 0.5, 1.0, 2.0, 4.0, 6.0, 10.0, 20.0, 40.0})
        if (auto ok = loops.add(newtons); !ok) return ok.error();
    if (auto ok = options.report_progress(0.9); !ok) return ok.error();
    StudyPlot& margins = out.plot("Phase margin of the transducer's loop", "force (N)", "degrees");
    margins.log_x = true;
    for (std::size_t k = 0; k < 3; ++k) {
        margins.add(Loops::description(k), loops.margins[k]);
        out.claim(fmt::format("smallest phase margin from 0.02 to 40 N, {}", Loops::description(k)), loops.margins[k].min(), "degrees")
            .allow_min(45, "thesis 4.2: a \"negative feedback loop\"; 45 degrees is our choice")
            .explain_if_needed(
                "stable, but it rings: the sensor's node is a second pole, and no published part compensates it. The capacitance of the "
                "sensor and its wire is not published, and the netlists have none");
    }
    const double min_gain = 20 * std::log10(20);
    out.claim("loop gain at 0.2 N", loops.gain.at(0.2), "dB").allow_min(min_gain, "V_X within 5 % of V_Y, as in the study fig22");
    out.claim("loop gain at 4 N", loops.gain.at(4), "dB").allow_min(min_gain, "V_X within 5 % of V_Y, as in the study fig22");
    out.claim("loop gain at 40 N", loops.gain.at(40), "dB");
    StudyPlot& gain = out.plot("Loop gain at 10 Hz", "force (N)", "dB");
    gain.log_x = true;
    gain.add("loop", loops.gain);
    return out;
}

const Study study{"transducer-loop", "The transducer's loop over the force",
                  "The amplifier \"provides a feedback loop control to force V_X to follow V_Y\" (thesis 4.2); the loop's gain and "
                  "stability are not published",
                  compute};

}  // namespace corpuscle::studies::transducer_loop
