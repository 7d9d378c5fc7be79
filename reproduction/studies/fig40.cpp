// Fig. 40: SA-I's chip under the press stimulus: the current into its oscillator, membrane and spikes, and its frequency compared with the
// model's.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/chip_vs_model.hpp"

namespace corpuscle::studies::fig40 {

/// Compares the spikes of chip and model. `low_leak_spikes`: of the chip with high-threshold switches.
void report_pattern(const ChipVsModel& b, const std::vector<double>& low_leak_spikes, StudyResult& out) {
    const auto& chip = b.chip.spikes;
    const auto f = press::frequency_at_start(chip), expected = press::frequency_at_start(b.model_spikes),
               low_leak = press::frequency_at_start(low_leak_spikes);
    const auto reason =
        fmt::format("leakage of its switches: with high-threshold switches the frequency 100 ms before the end of the plateau is {:.1f} Hz",
                    low_leak.at(press::plateau_end.from));
    const std::string similar = "thesis 4.4: similar to the model's of fig. 17c; the published value is the model's, computed here";
    out.claim("number of spikes", static_cast<double>(chip.size())).derived_as(static_cast<double>(b.model_spikes.size()), similar);
    out.claim("spikes while the force rises", press::spike_count(chip, press::protraction))
        .derived_as(press::spike_count(b.model_spikes, press::protraction), similar);
    for (const auto& [what, computed, model_value, unit] :
         {std::tuple{"spikes on the plateau", press::spike_count(chip, press::plateau), press::spike_count(b.model_spikes, press::plateau),
                     ""},
          {"highest frequency", f.max(), expected.max(), "Hz"},
          {"frequency 20 ms after the plateau begins", f.at(press::plateau.from + 0.02), expected.at(press::plateau.from + 0.02), "Hz"},
          {"frequency 100 ms before the plateau ends", f.at(press::plateau_end.from), expected.at(press::plateau_end.from), "Hz"}})
        if (auto& c = out.claim(what, computed, unit).derived_as(model_value, similar); c.needs_explanation()) c.explain(reason);
    const auto plateau = f.between(press::plateau.from, press::plateau.to - 0.05);
    out.claim("spikes at rest", press::spike_count(chip, press::rest)).allow_range(0, 0, "thesis 1.2, fig. 5a");
    out.claim_true("frequency highest while the force rises, then sustained but slowly decaying",
                   f.x_of_max() < press::plateau.from && std::is_sorted(plateau.y.rbegin(), plateau.y.rend()) &&
                       press::spike_count(chip, press::plateau_end) > 0,
                   "thesis 1.2, fig. 5a");
    out.claim("spikes from the retraction on", press::spike_count(chip, {press::retraction.from, 1}))
        .allow_max(1, "thesis 1.2: almost no response");
}

/// Claims on the glitches of the input current I, and on the charging of the membrane.
void report_glitches(const TrialResult& chip, StudyResult& out) {
    const auto& I = chip.probes.at("i(vi)");
    // the spikes up to the end of the plateau
    const std::vector<double> spikes_under_force(
        chip.spikes.begin(), chip.spikes.begin() + static_cast<std::ptrdiff_t>(press::spike_count(chip.spikes, {0, press::plateau.to})));
    out.claim("smallest glitch in I at a spike, over I before it", min_jump_ratio(I, spikes_under_force, 1.5e-3), "times")
        .allow_min(1.2, "thesis 4.4: glitches in the input signal I at each firing event; a fifth is our choice");
    // the output s is high while the membrane is charged
    const double charging_time = longest_time_above(chip.probes.at("v(s)"), 0.35);
    double shortest = 1;  // s, interval between spikes
    for (std::size_t k = 1; k < chip.spikes.size(); ++k) shortest = std::min(shortest, chip.spikes[k] - chip.spikes[k - 1]);
    out.claim("charging time of the membrane", charging_time, "s");
    out.claim("charging time of the membrane over the shortest interval between spikes", 100 * charging_time / shortest, "%")
        .allow_max(10, "thesis 4.4: charges very fast; a tenth is our choice");
    const double closing = chip.probes.at("v(xrectb.en)").crossing(0.35, 0.2);
    // largest change (A) of a current between two samples while I_B's rectifier closes its switch
    const auto jump = [&](const char* curve) {
        const auto around = chip.probes.at(curve).between(closing - 1e-3, closing + 0.5e-3);
        double largest = 0;
        for (std::size_t k = 1; k < around.y.size(); ++k) largest = std::max(largest, std::abs(around.y[k] - around.y[k - 1]));
        return largest;
    };
    out.claim("initial glitch when I_B's rectifier switches: step of I", jump("i(vi)"), "A");
    out.claim_true("the initial glitch of I comes from a rectified component, not from I_A",
                   jump("i(vib)") > 3 * jump("i(via)") && jump("i(vi)") > 3 * jump("i(via)"),
                   "thesis 4.4, as errata S18 corrects it: I_B and I_C");
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    const auto b = compare_chip_with_model(
        {.afferent = "sa1-circuit", .rate = 20e3, .probes = {"i(vi)", "i(via)", "i(vib)", "i(vic)", "v(u)", "v(s)", "v(xrectb.en)"}},
        "sa1");
    if (!b) return b.error();
    const auto low_leak_spikes = simulate_train({"sa1-circuit", "press", {"sa1-circuit.hv_switches=1"}});
    if (!low_leak_spikes) return low_leak_spikes.error();
    if (auto ok = options.report_progress(0.9); !ok) return ok.error();
    report_pattern(*b, *low_leak_spikes, out), report_glitches(b->chip, out);
    const auto& probes = b->chip.probes;
    StudyPlot& inputs =
        out.plot("40a, input signals", "time (s)", "pA").describe_published("glitches in I at each spike, and one at the beginning");
    for (const auto& [name, curve] : {std::pair{"I", "i(vi)"}, {"I_A", "i(via)"}, {"I_B", "i(vib)"}, {"I_C", "i(vic)"}})
        inputs.add(name, probes.at(curve).scaled(1, 1e12));
    out.plot("40b, membrane and output", "time (s)", "V")
        .describe_published("u is charged very fast at each spike of s")
        .add("u", probes.at("v(u)"))
        .add("s", probes.at("v(s)"));
    out.plot("Frequency compared with the model's of fig. 17c", "time (s)", "frequency (Hz)")
        .describe_published("similar to the model's")
        .points("chip", press::frequency_at_start(b->chip.spikes))
        .points("model", press::frequency_at_start(b->model_spikes));
    out.plot("Spikes", "time (s)", "").raster_row("chip", b->chip.spikes).raster_row("model", b->model_spikes);
    out.note(
        "Gains as intended (errata S9a, S10a), with the matching leak of 7 pA and membrane of 4.5 pF. For the tables' sizes and the "
        "published leak of 5 pA and membrane of 1.8 pF see the study errata-signal.");
    return out;
}

const Study study{"fig40", "SA-I's chip under the press stimulus",
                  "Glitches in its input, and a frequency similar to the model's of fig. 17c. Thesis 4.4, fig. 40", compute};

}  // namespace corpuscle::studies::fig40
