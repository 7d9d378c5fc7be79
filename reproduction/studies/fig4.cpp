// The force of the fingertip experiment: thesis 1.2, fig. 4.

#include <cmath>

#include "reproduction/claims/check_all.hpp"
#include "reproduction/claims/studies.hpp"
#include "reproduction/skin/direction_experiment.hpp"
#include "reproduction/thesis/press.hpp"

namespace corpuscle::studies::fig4 {

constexpr auto source = "thesis 1.2, fig. 4";

/// Time (s) from the first to the last change of the force within a window.
double ramp_duration(const StudyCurve& force, const TimeWindow& window) {
    double from = Claim::none, to = Claim::none;
    const auto part = force.between(window.from, window.to);
    for (std::size_t k = 1; k < part.x.size(); ++k)
        if (part.y[k] != part.y[k - 1]) {
            if (std::isnan(from)) from = part.x[k - 1];
            to = part.x[k];
        }
    return to - from;
}

/// Largest difference (N) between retraction and time-reversed protraction.
double asymmetry(const StudyCurve& force) {
    const double middle = (press::protraction.from + press::retraction.to) / 2;
    double out = 0;
    for (double t = press::protraction.from; t < press::protraction.to; t += 1e-3)
        out = std::max(out, std::abs(force.at(t) - force.at(2 * middle - t)));
    return out;
}

/// Largest difference (N) between protraction and half a cosine.
double cosine_error(const StudyCurve& force) {
    double out = 0;
    const auto ramp = force.between(press::protraction.from, press::protraction.to);
    for (std::size_t k = 0; k < ramp.x.size(); ++k) {
        const double fraction = (ramp.x[k] - press::protraction.from) / (press::protraction.to - press::protraction.from);
        out = std::max(out, std::abs(ramp.y[k] - (force.min() + (force.max() - force.min()) * (1 - std::cos(M_PI * fraction)) / 2)));
    }
    return out;
}

Result<StudyResult> compute(const StudyOptions&) {
    StudyResult out;
    const auto force = TRY(press::force_curve(1e-4));
    const double mid_plateau = (press::plateau.from + press::plateau.to) / 2, end = press::after.to;
    const double up = ramp_duration(force, {0, mid_plateau}), down = ramp_duration(force, {mid_plateau, end});
    out.claim("smallest force", force.min(), "N").published_as(0.2, source);
    out.claim("largest force", force.max(), "N").published_as(4, source);
    out.claim("duration of the rest before protraction", force.crossing(force.min() + 1e-9), "s").published_as(250e-3, source);
    out.claim("duration of protraction", up, "s").published_as(125e-3, source);
    // from the first to the last change of the whole stimulus, without both ramps
    out.claim("duration of the plateau", ramp_duration(force, {0, end}) - up - down, "s").published_as(250e-3, source);
    out.claim("duration of retraction", down, "s")
        .published_as(250e-3, source)
        .explain(
            "\"symmetrical to the protraction phase\" and 250 ms contradict each other; symmetry is used here (errata B1). A later paper "
            "of the same group has forces that rise in 125 ms");
    out.claim("duration of retraction, if symmetrical", down, "s")
        .published_as(125e-3, "thesis 1.2: \"symmetrical to the protraction phase\"");
    out.claim("retraction against time-reversed protraction, largest difference", asymmetry(force), "N")
        .allow_max(1e-3, "thesis 1.2: symmetrical; within 1 mN here");
    out.claim("protraction against half a cosine, largest difference", cosine_error(force), "N")
        .allow_max(1e-3, "thesis 1.2: a sinusoidal ramp; within 1 mN here");
    out.claim("steepest slope", force.slope().max(), "N/s");
    const auto slow_retraction = TRY(trial_force({{}, "press", {"press.t_down=250ms"}}));
    for (const char* name : {"sa1", "fa1"}) {
        const auto as_used = simulate_train({name}), as_printed = simulate_train({name, "press", {"press.t_down=250ms"}});
        TRY(check_all(as_used, as_printed));
        const TimeWindow later{press::retraction.from, 2};
        out.claim(std::string(name) + ": spikes from the start of a retraction of 125 ms", press::spike_count(*as_used, later), "spikes");
        out.claim(std::string(name) + ": spikes from the start of a retraction of 250 ms", press::spike_count(*as_printed, later),
                  "spikes");
    }
    out.plot("Force of the experiment", "time (s)", "force (N)")
        .add("as used here: retraction of 125 ms", force)
        .add("as printed: retraction of 250 ms", slow_retraction.curve())
        .describe_published("rest, sinusoidal ramp, plateau and a symmetrical retraction, 0.2 to 4 N");
    out.next_kind = ClaimKind::fitted;  // the directions of the built-in skins are drawn after this paper
    TRY(directions::report(out));
    out.next_kind = {};
    out.note(
        "The abstract of Birznieks et al. 2001 reports 196 afferents, not \"196 afferent nerve impulses\" (errata B18a). The protocol of "
        "250, 125, 250 and 125 ms between 0.2 and 4 N was found in the thesis only.");
    return out;
}

const Study study{
    "fig4", "The fingertip experiment: force, directions and places",
    "Four phases between 0.2 and 4 N: 250 ms of rest, a sinusoidal ramp of 125 ms, a plateau of 250 ms, and a retraction "
    "described both as 250 ms and as symmetrical. The force acts in five directions and at several places. Thesis 1.2, fig. 4",
    ClaimKind::input, compute};

}  // namespace corpuscle::studies::fig4
