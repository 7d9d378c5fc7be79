// Thesis fig. 9: Lee's FA-I system as described in 2.2 and 3.1. Neither the neuron's equation nor its parameters are published, so both are
// our choice (errata B20).

#include <fmt/format.h>
#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/press.hpp"

namespace corpuscle::studies::fig9 {

/// Lee's system with its two neurons: currents I, membrane voltages u and threshold rises a, for rising (+) and falling (-) force.
Result<TrialResult> simulate_lee(std::vector<std::string> settings = {}, const char* stimulus = "press") {
    return run_trial({.afferent = "fa1-lee",
                      .stimulus = stimulus,
                      .settings = std::move(settings),
                      .probes = {"I_+", "I_-", "u_+", "u_-", "a_+", "a_-"}});
}

/// Number of spikes, counted as sudden falls of the membrane by more than a tenth of its largest value.
double count_resets(const StudyCurve& u) {
    double out = 0;
    for (std::size_t k = 1; k < u.y.size(); ++k) out += u.y[k - 1] - u.y[k] > 0.1 * u.max();
    return out;
}

/// Charge (coulombs) of a current within a window.
double charge(const StudyCurve& current, const TimeWindow& window) {
    double out = 0;
    for (std::size_t k = 1; k < current.x.size(); ++k)
        if (current.x[k] >= window.from && current.x[k] < window.to) out += current.y[k] * (current.x[k] - current.x[k - 1]);
    return out;
}

void add_component_claims(StudyResult& out, const TrialResult& response) {
    const auto &plus = response.probes.at("I_+"), &minus = response.probes.at("I_-");
    const TimeWindow rising{0, 0.5}, falling{0.5, 1.0};  // split at the middle of the plateau
    out.claim("fraction of I+ that flows while the force rises", 100 * charge(plus, rising) / charge(plus, {}), "%")
        .derived_as(100, "thesis 3.1, eq. 2");
    out.claim("fraction of I- that flows while the force falls", 100 * charge(minus, falling) / charge(minus, {}), "%")
        .derived_as(100, "thesis 3.1, eq. 3");
    out.claim("I+ and I- in the last 100 ms of the plateau", charge(plus, press::plateau_end) + charge(minus, press::plateau_end), "C")
        .allow_range(0, 0, "thesis 2.2: no static component");
    const double up = count_resets(response.probes.at("u_+")), down = count_resets(response.probes.at("u_-"));
    out.claim("spikes of the neuron for rising force, over all spikes until the middle of the plateau",
              up / press::spike_count(response.spikes, rising))
        .allow_range(1, 1, "thesis 3.1: two independent neurons");
    out.claim("spikes of the neuron for falling force, over all spikes after the middle of the plateau",
              down / press::spike_count(response.spikes, falling))
        .allow_range(1, 1, "thesis 3.1: two independent neurons");
}

/// Under a long slope each spike raises the threshold, which lengthens the intervals.
Result<void> add_inhibition_claims(StudyResult& out) {
    const std::vector<std::string> ramp = {"ramp-hold.F_max=5", "ramp-hold.t_up=500ms", "ramp-hold.t_hold=100ms", "fa1-lee.k=2e-6"};
    auto without_jump = ramp;
    without_jump.push_back("fa1-lee.dV_th=0");
    const auto with = simulate_lee(ramp, "ramp-hold"), without = simulate_lee(without_jump, "ramp-hold");
    if (!with) return with.error();
    if (!without) return without.error();
    const TimeWindow slope{0.25, 0.75};  // s: the ramp
    // first frequency over last frequency of the slope
    const auto slowdown = [&](const TrialResult& t) { return measure<FirstRate>(t.spikes, slope) / measure<LastRate>(t.spikes, slope); };
    out.claim("first frequency of a long slope over its last frequency", slowdown(*with))
        .allow_min(1.1, "thesis 2.2: inhibited after each spike by a feedback to the threshold; a tenth is our choice");
    out.claim("first frequency of a long slope over its last frequency, without the threshold feedback", slowdown(*without))
        .allow_range(0.95, 1.05, "a regular train except for its grid of 1 ms; the range is our choice");
    out.claim("spikes of the slope without the threshold feedback over those with it",
              press::spike_count(without->spikes, slope) / press::spike_count(with->spikes, slope))
        .allow_min(1.1, "thesis 2.2: inhibition; a tenth is our choice");
    out.plot("Rise of the threshold under a long slope, ten times the gain", "time (s)", "a (V)").add("a_+", with->probes.at("a_+"));
    return {};
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    const auto response = simulate_lee();
    if (!response) return response.error();
    const auto fa1 = simulate_train({"fa1"});
    if (!fa1) return fa1.error();
    const auto force = press::force_curve(1e-4);
    if (!force) return force.error();
    add_component_claims(out, *response);
    if (auto ok = options.report_progress(0.5); !ok) return ok.error();
    if (auto ok = add_inhibition_claims(out); !ok) return ok.error();
    for (const auto& [name, train] : {std::pair{"fa1-lee", &response->spikes}, {"fa1", &*fa1}}) {
        out.claim(fmt::format("{}: spikes in protraction and retraction", name),
                  press::spike_count(*train, press::protraction) + press::spike_count(*train, press::retraction), "spikes")
            .allow_min(2, "thesis 1.2 and 2.2");
        auto& c = out.claim(fmt::format("{}: spikes in plateau and after", name),
                            press::spike_count(*train, press::plateau) + press::spike_count(*train, press::after), "spikes")
                      .allow_range(0, 0, "thesis 1.2: only in protraction and retraction");
        if (c.needs_explanation()) c.explain("a high-pass of 2 Hz continues after the ramp (errata B13); a plain derivative ends with it");
    }
    out.plot("Spikes under the press stimulus", "time (s)", "").raster_row("fa1-lee", response->spikes).raster_row("fa1", *fa1);
    out.plot("Currents of the fixed-point model", "time (s)", "current (uA)")
        .add("I+", response->probes.at("I_+").scaled(1, 1e6))
        .add("I-", response->probes.at("I_-").scaled(1, 1e6))
        .describe_published("one current from rising and one from falling force, each drives its own neuron");
    out.plot("Instantaneous frequency", "time (s)", "frequency (Hz)")
        .points("fa1-lee", press::frequency_at_start(response->spikes))
        .points("fa1", press::frequency_at_start(*fa1))
        .add("force, 10 Hz per newton", force->scaled(1, 10));
    out.note(
        "The thesis says that Lee's neuron has no leak, an adaptive threshold, and a membrane that \"increases by a non-proportional "
        "rate\". This increase has no equation and is not modelled. \"Each with its own parameters\" is not modelled either: both neurons "
        "have the same parameters here.");
    out.note("The hardware (an FPGA that processes many sensors in real time) is not modelled; here fixed-point arithmetic runs at 1 kHz.");
    return out;
}

const Study study{"fig9", "Lee's FA-I system",
                  "No static component. Rising and falling force drive two independent neurons, which an adaptive threshold inhibits after "
                  "each spike. Thesis 2.2, 3.1, fig. 9",
                  compute};

}  // namespace corpuscle::studies::fig9
