// Thesis fig. 8: Kim's SA-I system, sensor to spikes in words, as 2.2 and 3.1 tell it; its values are ours.

#include <fmt/format.h>
#include <cmath>

#include "study/studies.hpp"
#include "study/thesis/press.hpp"

namespace corpuscle::studies::fig8 {

/// SA-IA under a ramp to a force in some time: what its two parts are at the ramp's middle and in the hold.
struct Parts {
    double ramp_dynamic = 0, hold_static = 0, hold_dynamic = 0, down_dynamic = 0;  // A
};
Result<Parts> parts_under(double force, double seconds) {
    const auto told = told_of({.afferent = "sa1a+lif-a",
                               .stimulus = "ramp-hold",
                               .settings = {fmt::format("ramp-hold.F_max={}", force), fmt::format("ramp-hold.t_up={}", seconds),
                                            fmt::format("ramp-hold.t_down={}", seconds)},
                               .rate = 1e3,
                               .traces = {"I_s", "I_d"}});
    if (!told) return told.error();
    const auto &s = told->traces.at("I_s"), &d = told->traces.at("I_d");
    const double up = 0.25 + seconds / 2, hold = 0.25 + seconds + 0.5, down = 0.25 + seconds + 1 + seconds / 2;
    return Parts{d.at(up), s.at(hold), d.at(hold), d.at(down)};
}

Result<void> tell_parts(Outcome& out) {
    const auto once = parts_under(1, 0.1), twice = parts_under(2, 0.1), slower = parts_under(1, 0.2);
    for (const auto* p : {&once, &twice, &slower})
        if (!*p) return p->error();
    out.claim("static part at twice the force", twice->hold_static / once->hold_static).held_to(2, "thesis 2.2: proportional to the force");
    out.claim("dynamic part at half the slope", slower->ramp_dynamic / once->ramp_dynamic)
        .held_to(0.5, "thesis 2.2: proportional to its rate of change");
    out.claim("dynamic part in the hold", once->hold_dynamic, "A").between(0, 0, "thesis 2.2: due to the ramp");
    out.claim("dynamic part of falling force over that of rising", once->down_dynamic / once->ramp_dynamic)
        .held_to(1, "thesis 3.1: for both positive and negative changes");
    return {};
}

Result<Outcome> work(const StudyOptions& options) {
    Outcome out;
    if (auto ok = tell_parts(out); !ok) return ok.error();
    const auto kim = told_of({.afferent = "sa1-kim", .traces = {"F_read", "I", "u"}}), own = told_of({.afferent = "sa1"});
    if (!kim) return kim.error();
    if (!own) return own.error();
    if (auto ok = options.at(0.6); !ok) return ok.error();
    const auto force = press::samples(1e-4);
    if (!force) return force.error();
    const auto& spikes = kim->spikes;
    double off = 0;
    for (const double t : {0.2, 0.3, 0.5, 0.7}) off = std::max(off, std::abs(kim->traces.at("F_read").at(t) - force->at(t)));
    out.claim("what the converter reads off the force, at four times of the press", off, "N")
        .at_most(0.1, "thesis 2.2: the force signal in the digital domain; the range is ours, and a sample is 1 ms old at most");
    const double up = measure<PeakRate>(spikes, press::up), held = measure<LastRate>(spikes, press::plateau),
                 down = press::count(spikes, press::down);
    out.claim("peak in protraction over the plateau's last", up / held).at_least(1, "thesis 3.1: fires faster in protraction");
    const Stretch plateau_late{0.5, 0.625};
    out.claim("spikes in retraction", down, "spikes");
    out.claim("mean frequency in retraction over that of the plateau's second half",
              measure<MeanRate>(spikes, press::down) / measure<MeanRate>(spikes, plateau_late))
        .at_least(1, "thesis 3.1: the output increases for negative changes, too (printed \"at the protraction phase\"; errata B11a)");
    out.claim("its spikes in retraction over those of sa1, more by", down - press::count(own->spikes, press::down), "spikes")
        .at_least(1, "thesis 3.1 and 3.3: SA-IA fires in retraction, the nerve and SA-IB hardly");
    const Stretch settled{press::plateau.from + 50e-3, press::plateau.to};
    out.claim("plateau's last frequency over its first, from 50 ms on",
              measure<LastRate>(spikes, settled) / measure<FirstRate>(spikes, settled))
        .between(0.9, 1.1, "thesis 3.3: SA-IA does not take the slow decay into account; a tenth is ours");
    out.plot("Spikes under the press", "time (s)", "").row("sa1-kim", spikes).row("sa1", own->spikes);
    out.plot("Instantaneous frequency", "time (s)", "frequency (Hz)")
        .points("sa1-kim", press::frequency(spikes))
        .points("sa1", press::frequency(own->spikes))
        .add("force, 10 Hz for a newton", force->times(1, 10))
        .shape("rises with the force's slope, up and down; the thesis finds that more suitable to SA-II");
    out.plot("Current of the words", "time (s)", "current (uA)").add("I", kim->traces.at("I").times(1, 1e6));
    out.note(
        "Kim's values (beta, k_s, k_d, the neuron's) are not in the thesis; those of sa1-kim are a choice (corpuscle list). Study kim "
        "holds the "
        "equation against the intervals that the paper's abstract prints. That it was fitted to ex vivo mouse skin is not checked.");
    return out;
}

const Study study{
    "fig8", "Kim's SA-I system",
    "Sensor, electronics, converter, then words: a static part and one of the force's rate of change, of either sign, into a leaky "
    "integrate-and-fire neuron. Thesis 2.2, 3.1, fig. 8",
    work};

}  // namespace corpuscle::studies::fig8
