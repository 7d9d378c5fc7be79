// Thesis fig. 9: Lee's FA-I system as 2.2 and 3.1 tell it; no equation of its neuron and no value is printed, so both are ours (errata
// B20).

#include <fmt/format.h>
#include <cmath>

#include "study/studies.hpp"
#include "study/thesis/press.hpp"

namespace corpuscle::studies::fig9 {

Result<Told> lee(std::vector<std::string> settings = {}, const char* stimulus = "press") {
    return told_of({.afferent = "fa1-lee",
                    .stimulus = stimulus,
                    .settings = std::move(settings),
                    .traces = {"I_+", "I_-", "u_+", "u_-", "a_+", "a_-"}});
}

/// How often a membrane falls by more than a tenth of its largest at once: its spikes.
double resets(const Line& u) {
    double out = 0;
    for (std::size_t k = 1; k < u.y.size(); ++k) out += u.y[k - 1] - u.y[k] > 0.1 * u.most();
    return out;
}

/// Charge of a current over a stretch; C.
double charge(const Line& i, const Stretch& s) {
    double out = 0;
    for (std::size_t k = 1; k < i.x.size(); ++k)
        if (i.x[k] >= s.from && i.x[k] < s.to) out += i.y[k] * (i.x[k] - i.x[k - 1]);
    return out;
}

void tell_parts(Outcome& out, const Told& told) {
    const auto &plus = told.traces.at("I_+"), &minus = told.traces.at("I_-");
    const Stretch rising{0, 0.5}, falling{0.5, 1.0};  // the plateau's middle between them
    out.claim("share of I+ that comes while the force rises", 100 * charge(plus, rising) / charge(plus, {}), "%")
        .held_to(100, "thesis 3.1, eq. 2");
    out.claim("share of I- that comes while it falls", 100 * charge(minus, falling) / charge(minus, {}), "%")
        .held_to(100, "thesis 3.1, eq. 3");
    out.claim("both in the plateau's last 100 ms", charge(plus, press::late) + charge(minus, press::late), "C")
        .between(0, 0, "thesis 2.2: no static component");
    const double up = resets(told.traces.at("u_+")), down = resets(told.traces.at("u_-"));
    out.claim("spikes of the first neuron, as a share of those until the plateau's middle", up / press::count(told.spikes, rising))
        .between(1, 1, "thesis 3.1: two independent neurons");
    out.claim("spikes of the second, of those after it", down / press::count(told.spikes, falling))
        .between(1, 1, "thesis 3.1: two independent neurons");
}

/// Under a lasting slope the threshold's rise stretches the intervals.
Result<void> tell_inhibition(Outcome& out) {
    const std::vector<std::string> ramp = {"ramp-hold.F_max=5", "ramp-hold.t_up=500ms", "ramp-hold.t_hold=100ms", "fa1-lee.k=2e-6"};
    auto without_jump = ramp;
    without_jump.push_back("fa1-lee.dV_th=0");
    const auto with = lee(ramp, "ramp-hold"), without = lee(without_jump, "ramp-hold");
    if (!with) return with.error();
    if (!without) return without.error();
    const Stretch slope{0.25, 0.75};
    const auto stretched = [&](const Told& t) { return measure<FirstRate>(t.spikes, slope) / measure<LastRate>(t.spikes, slope); };
    out.claim("first frequency of a lasting slope over its last", stretched(*with))
        .at_least(1.1, "thesis 2.2: inhibited after each spike by a feedback to the threshold; a tenth is ours");
    out.claim("the same without it", stretched(*without)).between(0.95, 1.05, "an even train, but for its grid of 1 ms: ours");
    out.claim("spikes of the slope without it, over those with it",
              press::count(without->spikes, slope) / press::count(with->spikes, slope))
        .at_least(1.1, "thesis 2.2: inhibition; a tenth is ours");
    out.plot("Threshold's rise under a lasting slope, ten times the gain", "time (s)", "a (V)").add("a_+", with->traces.at("a_+"));
    return {};
}

Result<Outcome> work(const StudyOptions& options) {
    Outcome out;
    const auto told = lee();
    if (!told) return told.error();
    const auto own = train_of({"fa1"});
    if (!own) return own.error();
    const auto force = press::samples(1e-4);
    if (!force) return force.error();
    tell_parts(out, *told);
    if (auto ok = options.at(0.5); !ok) return ok.error();
    if (auto ok = tell_inhibition(out); !ok) return ok.error();
    for (const auto& [name, train] : {std::pair{"fa1-lee", &told->spikes}, {"fa1", &*own}}) {
        out.claim(fmt::format("{}: spikes in protraction and retraction", name),
                  press::count(*train, press::up) + press::count(*train, press::down), "spikes")
            .at_least(2, "thesis 1.2 and 2.2");
        auto& c = out.claim(fmt::format("{}: spikes in plateau and after", name),
                            press::count(*train, press::plateau) + press::count(*train, press::after), "spikes")
                      .between(0, 0, "thesis 1.2: only in protraction and retraction");
        if (c.needs_reason()) c.because("a high-pass of 2 Hz goes on after the ramp (errata B13); a bare slope ends with it");
    }
    out.plot("Spikes under the press", "time (s)", "").row("fa1-lee", told->spikes).row("fa1", *own);
    out.plot("Currents of the words", "time (s)", "current (uA)")
        .add("I+", told->traces.at("I_+").times(1, 1e6))
        .add("I-", told->traces.at("I_-").times(1, 1e6))
        .shape("one from rising, one from falling force, to a neuron each");
    out.plot("Instantaneous frequency", "time (s)", "frequency (Hz)")
        .points("fa1-lee", press::frequency(told->spikes))
        .points("fa1", press::frequency(*own))
        .add("force, 10 Hz for a newton", force->times(1, 10));
    out.note(
        "The thesis says of Lee's neuron that it has no leak, an adaptive threshold, and a membrane that \"increases by a non-proportional "
        "rate\"; the "
        "last has no equation and is not modelled. \"Each with its own parameters\" neither: both neurons have the same here.");
    out.note(
        "The hardware (an FPGA that takes many sensors in real time) has no counterpart; fixed-point words at 1 kHz are what runs here.");
    return out;
}

const Study study{
    "fig9", "Lee's FA-I system",
    "No static part; rising and falling force go to two independent neurons, which are inhibited after a spike by a threshold that adapts. "
    "Thesis 2.2, 3.1, fig. 9",
    work};

}  // namespace corpuscle::studies::fig9
