// Thesis fig. 8: Kim's digital SA-I system from sensor to spikes, as described in 2.2 and 3.1; its parameters are our choice.

#include <fmt/format.h>
#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/press.hpp"

namespace corpuscle::studies::fig8 {

/// Components (A) of SA-IA's current: the dynamic one in the middle of the rising ramp, both in the hold, and the dynamic one in the middle
/// of the falling ramp.
struct Components {
    double ramp_dynamic = 0, hold_static = 0, hold_dynamic = 0, down_dynamic = 0;
};
/// Under ramps of this duration (s) from 0 to a force (N) and back, with a hold of 1 s.
Result<Components> components_under(double force, double seconds) {
    const auto response = run_trial({.afferent = "sa1a+lif-a",
                                     .stimulus = "ramp-hold",
                                     .settings = {fmt::format("ramp-hold.F_max={}", force), fmt::format("ramp-hold.t_up={}", seconds),
                                                  fmt::format("ramp-hold.t_down={}", seconds)},
                                     .rate = 1e3,
                                     .probes = {"I_s", "I_d"}});
    if (!response) return response.error();
    const auto &s = response->probes.at("I_s"), &d = response->probes.at("I_d");
    const double up = 0.25 + seconds / 2, hold = 0.25 + seconds + 0.5, down = 0.25 + seconds + 1 + seconds / 2;
    return Components{d.at(up), s.at(hold), d.at(hold), d.at(down)};
}

Result<void> add_component_claims(StudyResult& out) {
    const auto once = components_under(1, 0.1), twice = components_under(2, 0.1), slower = components_under(1, 0.2);
    for (const auto* p : {&once, &twice, &slower})
        if (!*p) return p->error();
    out.claim("static component at twice the force, over that at the force", twice->hold_static / once->hold_static)
        .derived_as(2, "thesis 2.2: proportional to the force");
    out.claim("dynamic component at half the slope of the ramp, over that at the full slope", slower->ramp_dynamic / once->ramp_dynamic)
        .derived_as(0.5, "thesis 2.2: proportional to its rate of change");
    out.claim("dynamic component in the hold", once->hold_dynamic, "A")
        .allow_range(0, 0, "thesis 2.2: the dynamic component is due to the ramp");
    out.claim("dynamic component of falling force over that of rising force", once->down_dynamic / once->ramp_dynamic)
        .derived_as(1, "thesis 3.1: for both positive and negative changes");
    return {};
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    if (auto ok = add_component_claims(out); !ok) return ok.error();
    const auto kim = run_trial({.afferent = "sa1-kim", .probes = {"F_read", "I", "u"}}), sa1 = run_trial({.afferent = "sa1"});
    if (!kim) return kim.error();
    if (!sa1) return sa1.error();
    if (auto ok = options.report_progress(0.6); !ok) return ok.error();
    const auto force = press::force_curve(1e-4);
    if (!force) return force.error();
    const auto& spikes = kim->spikes;
    double worst_error = 0;
    for (const double t : {0.2, 0.3, 0.5, 0.7})
        worst_error = std::max(worst_error, std::abs(kim->probes.at("F_read").at(t) - force->at(t)));
    out.claim("largest error of the converted force at four times of the stimulus", worst_error, "N")
        .allow_max(0.1, "thesis 2.2: the force signal in the digital domain; the range is our choice, a sample is up to 1 ms old");
    const double up = measure<PeakRate>(spikes, press::protraction), hold_rate = measure<LastRate>(spikes, press::plateau),
                 down = press::spike_count(spikes, press::retraction);
    out.claim("peak in protraction over the last frequency of the plateau", up / hold_rate)
        .allow_min(1, "thesis 3.1: fires faster in protraction");
    const TimeWindow plateau_late{0.5, 0.625};
    out.claim("spikes in retraction", down, "spikes");
    out.claim("mean frequency in retraction over that of the second half of the plateau",
              measure<MeanRate>(spikes, press::retraction) / measure<MeanRate>(spikes, plateau_late))
        .allow_min(1, "thesis 3.1: the output also increases for negative changes (printed \"at the protraction phase\"; errata B11a)");
    out.claim("spikes in retraction minus those of sa1 in retraction", down - press::spike_count(sa1->spikes, press::retraction), "spikes")
        .allow_min(1, "thesis 3.1 and 3.3: SA-IA fires in retraction, the nerve and SA-IB hardly do");
    const TimeWindow steady_plateau{press::plateau.from + 50e-3, press::plateau.to};
    out.claim("last frequency of the plateau over its first, from 50 ms on",
              measure<LastRate>(spikes, steady_plateau) / measure<FirstRate>(spikes, steady_plateau))
        .allow_range(0.9, 1.1, "thesis 3.3: SA-IA does not take the slow decay into account; a tenth is our choice");
    out.plot("Spikes under the press stimulus", "time (s)", "").raster_row("sa1-kim", spikes).raster_row("sa1", sa1->spikes);
    out.plot("Instantaneous frequency", "time (s)", "frequency (Hz)")
        .points("sa1-kim", press::frequency_at_start(spikes))
        .points("sa1", press::frequency_at_start(sa1->spikes))
        .add("force, 10 Hz per newton", force->scaled(1, 10))
        .describe_published("rises with the slope of the force in both directions; the thesis finds that more suitable to SA-II");
    out.plot("Current of the fixed-point model", "time (s)", "current (uA)").add("I", kim->probes.at("I").scaled(1, 1e6));
    out.note(
        "The thesis does not give Kim's parameters (beta, k_s, k_d, those of the neuron); those of sa1-kim are our choice (corpuscle "
        "list). The study kim compares the equation with the intervals in the paper's abstract. Whether the model was fitted to ex vivo "
        "mouse skin is not checked.");
    return out;
}

const Study study{"fig8", "Kim's SA-I system",
                  "Sensor, electronics, converter, then digital processing: a static component and a dynamic one, for a rate of change of "
                  "either sign, drive a leaky integrate-and-fire neuron. Thesis 2.2, 3.1, fig. 8",
                  compute};

}  // namespace corpuscle::studies::fig8
