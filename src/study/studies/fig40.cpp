// SA-I's chip under the press, fig. 40: the current into its oscillator, membrane and spikes, and its frequency beside the model's.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "study/studies.hpp"
#include "study/thesis/beside.hpp"

namespace corpuscle::studies::fig40 {

namespace P = press;

void tell_pattern(const Beside& b, const std::vector<double>& tight, Outcome& out) {
    const auto& chip = b.chip.spikes;
    const auto f = press::frequency(chip), wanted = press::frequency(b.model), without = press::frequency(tight);
    const auto reason =
        fmt::format("what its switches leak: with those of the higher threshold, 100 ms before the plateau's end, it is {:.1f} Hz",
                    without.at(P::late.from));
    const std::string similar = "thesis 4.4: similar to the model's of fig. 17c; printed: the model's, made here";
    out.claim("spikes", static_cast<double>(chip.size())).held_to(static_cast<double>(b.model.size()), similar);
    out.claim("spikes while the force rises", press::count(chip, P::up)).held_to(press::count(b.model, P::up), similar);
    for (const auto& [what, made, printed, unit] :
         {std::tuple{"spikes on the plateau", press::count(chip, P::plateau), press::count(b.model, P::plateau), ""},
          {"highest frequency", f.most(), wanted.most(), "Hz"},
          {"frequency as the plateau begins", f.at(P::plateau.from + 0.02), wanted.at(P::plateau.from + 0.02), "Hz"},
          {"... 100 ms before its end", f.at(P::late.from), wanted.at(P::late.from), "Hz"}})
        if (auto& c = out.claim(what, made, unit).held_to(printed, similar); c.needs_reason()) c.because(reason);
    const auto plateau = f.between(P::plateau.from, P::plateau.to - 0.05);
    out.claim("spikes at rest", press::count(chip, P::rest)).between(0, 0, "thesis 1.2, fig. 5a");
    out.finds("highest while the force rises, then a sustained but slowly decaying frequency",
              f.peak() < P::plateau.from && std::is_sorted(plateau.y.rbegin(), plateau.y.rend()) && press::count(chip, P::late) > 0,
              "thesis 1.2, fig. 5a");
    out.claim("spikes from the retraction on", press::count(chip, {P::down.from, 1})).at_most(1, "thesis 1.2: almost no response");
}

void tell_glitches(const Told& chip, Outcome& out) {
    const auto& I = chip.traces.at("i(vi)");
    const std::vector<double> pressed(chip.spikes.begin(),
                                      chip.spikes.begin() + static_cast<std::ptrdiff_t>(press::count(chip.spikes, {0, P::plateau.to})));
    out.claim("glitch in I at each firing: least, over I before it", least_jump(I, pressed, 1.5e-3), "times")
        .at_least(1.2, "thesis 4.4: glitches in the input signal I at each firing event; a fifth is set here");
    const double fills = longest_above(chip.traces.at("v(s)"), 0.35);
    double shortest = 1;
    for (std::size_t k = 1; k < chip.spikes.size(); ++k) shortest = std::min(shortest, chip.spikes[k] - chip.spikes[k - 1]);
    out.claim("the membrane is filled in", fills, "s");
    out.claim("... of the shortest interval", 100 * fills / shortest, "%")
        .at_most(10, "thesis 4.4: charges very fast; a tenth is set here");
    const double closes = chip.traces.at("v(xrectb.en)").where(0.35, 0.2);
    const auto jump = [&](const char* curve) {
        const auto near = chip.traces.at(curve).between(closes - 1e-3, closes + 0.5e-3);
        double most = 0;
        for (std::size_t k = 1; k < near.y.size(); ++k) most = std::max(most, std::abs(near.y[k] - near.y[k - 1]));
        return most;
    };
    out.claim("initial glitch, as I_B's rectifier switches: I jumps by", jump("i(vi)"), "A");
    out.finds("the initial glitch of I is of a rectified component, not of I_A",
              jump("i(vib)") > 3 * jump("i(via)") && jump("i(vi)") > 3 * jump("i(via)"),
              "thesis 4.4, as errata S18 corrects it: I_B and I_C");
}

Result<Outcome> work(const StudyOptions& options) {
    Outcome out;
    const auto b =
        beside({.afferent = "sa1-circuit", .rate = 20e3, .traces = {"i(vi)", "i(via)", "i(vib)", "i(vic)", "v(u)", "v(s)", "v(xrectb.en)"}},
               "sa1");
    if (!b) return b.error();
    const auto tight = train_of({"sa1-circuit", "press", {"sa1-circuit.hv_switches=1"}});
    if (!tight) return tight.error();
    if (auto ok = options.at(0.9); !ok) return ok.error();
    tell_pattern(*b, *tight, out), tell_glitches(b->chip, out);
    const auto& traces = b->chip.traces;
    Plot& in = out.plot("40a, input signals", "time (s)", "pA").shape("glitches in I at each firing, and one at its beginning");
    for (const auto& [name, curve] : {std::pair{"I", "i(vi)"}, {"I_A", "i(via)"}, {"I_B", "i(vib)"}, {"I_C", "i(vic)"}})
        in.add(name, traces.at(curve).times(1, 1e12));
    out.plot("40b, membrane and output", "time (s)", "V")
        .shape("u is charged very fast at each s")
        .add("u", traces.at("v(u)"))
        .add("s", traces.at("v(s)"));
    out.plot("Frequency beside the model's of fig. 17c", "time (s)", "frequency (Hz)")
        .shape("similar to the model's")
        .points("chip", press::frequency(b->chip.spikes))
        .points("model", press::frequency(b->model));
    out.plot("Spikes", "time (s)", "").row("chip", b->chip.spikes).row("model", b->model);
    out.note(
        "Gains as intended (errata S9a, S10a), and with them a leak of 7 pA and a membrane of 4.5 pF; with the tables' sizes and the "
        "printed "
        "5 pA and 1.8 pF: errata-signal.");
    return out;
}

const Study study{"fig40", "SA-I's chip under the press",
                  "Glitches in its input, and a frequency like the model's of fig. 17c. Thesis 4.4, fig. 40", work};

}  // namespace corpuscle::studies::fig40
