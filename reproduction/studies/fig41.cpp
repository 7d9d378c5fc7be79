// Fig. 41: FA-I's chip under the press stimulus: the current into its oscillator, membrane and spikes, and its frequency compared with the
// model's.

#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/chip_vs_model.hpp"

namespace corpuscle::studies::fig41 {

void report_pattern(const ChipVsModel& b, StudyResult& out) {
    const std::string similar = "thesis 4.4: similar to the model's of fig. 18; the published value is the model's, computed here";
    const auto& chip = b.chip.spikes;
    out.claim("number of spikes", static_cast<double>(chip.size())).derived_as(static_cast<double>(b.model_spikes.size()), similar);
    const auto f = press::frequency_at_start(chip), expected = press::frequency_at_start(b.model_spikes);
    for (const auto& [name, phase] : {std::pair{"rising", press::protraction}, {"falling", press::retraction}}) {
        out.claim(std::string("spikes while the force is ") + name, press::spike_count(chip, phase))
            .derived_as(press::spike_count(b.model_spikes, phase), similar);
        const TimeWindow window{phase.from, phase.to + 0.1};  // the ramp and 100 ms after it
        auto& c = out.claim(std::string("highest frequency, ") + name, f.between(window.from, window.to).max(), "Hz")
                      .derived_as(expected.between(window.from, window.to).max(), similar);
        if (c.needs_explanation())
            c.explain("each ramp has only two or three intervals, and each depends on the first spike; the comparator switches late");
    }
    out.claim_true("FA-I's chip responds to the ramps only: no spike at rest and in the last 100 ms of the plateau",
                   press::spike_count(chip, press::rest) == 0 && press::spike_count(chip, press::plateau_end) == 0 &&
                       press::spike_count(chip, press::protraction) > 0 && press::spike_count(chip, press::retraction) > 0,
                   "thesis 1.2, fig. 5b");
    out.claim_true("asymmetrical: a higher frequency while the force rises than while it falls",
                   f.between(press::protraction.from, press::plateau.from + 0.1).max() > f.between(press::retraction.from, 1).max(),
                   "thesis 1.2, fig. 5b");
    out.claim("delay of the first spike after the model's", chip.empty() ? NAN : chip[0] - b.model_spikes[0], "s");
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    const auto b = compare_chip_with_model({.afferent = "fa1-circuit", .rate = 20e3, .probes = {"i(vi)", "v(u)", "v(s)"}}, "fa1");
    if (!b) return b.error();
    if (auto ok = options.report_progress(0.9); !ok) return ok.error();
    report_pattern(*b, out);
    const auto& I = b->chip.probes.at("i(vi)");
    // the spikes up to the end of the plateau
    const std::vector<double> spikes_under_force(
        b->chip.spikes.begin(),
        b->chip.spikes.begin() + static_cast<std::ptrdiff_t>(press::spike_count(b->chip.spikes, {0, press::plateau.to})));
    out.claim("smallest glitch in I at a spike up to the end of the plateau, over I just before it",
              min_jump_ratio(I, spikes_under_force, 0.3e-3), "times")
        .explain(
            "FA-I's membrane capacitance is three times SA-I's, so it is charged at a third of the speed and draws a third of the current "
            "through the rectifier's capacitances");
    out.plot("41a, input", "time (s)", "pA").describe_published("similar to SA-I's").add("I", I.scaled(1, 1e12));
    out.plot("41b, membrane and output", "time (s)", "V")
        .describe_published("similar to the model's firing pattern")
        .add("u", b->chip.probes.at("v(u)"))
        .add("s", b->chip.probes.at("v(s)"));
    out.plot("Frequency compared with the model's of fig. 18c", "time (s)", "frequency (Hz)")
        .describe_published("similar to the model's")
        .points("chip", press::frequency_at_start(b->chip.spikes))
        .points("model", press::frequency_at_start(b->model_spikes));
    out.plot("Spikes", "time (s)", "").raster_row("chip", b->chip.spikes).raster_row("model", b->model_spikes);
    out.note(
        "Gains as intended (errata S15), a leak of 10 pA and a membrane of 14.4 pF. For table 8's sizes, a leak of 5 pA and a membrane of "
        "5.4 pF see the study errata-signal.");
    return out;
}

const Study study{"fig41", "FA-I's chip under the press stimulus",
                  "Signals and a firing pattern similar to the model's of fig. 18. Thesis 4.4, fig. 41", compute};

}  // namespace corpuscle::studies::fig41
