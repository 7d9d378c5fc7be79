// Thesis fig. 18: the FA-I model under the press stimulus, at the thesis's 1 ms.

#include <fmt/format.h>
#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/press.hpp"

namespace corpuscle::studies::fig18 {

constexpr double leak = 1e-6, C = 500e-9;                       // A, F: thesis 3.4
constexpr TimeWindow rising{0.25, 0.625}, falling{0.625, 1.0};  // s: protraction and plateau; retraction and the time after it

/// The receptor's currents I_A and I_B, of which one is always zero, and their sum I.
struct Currents {
    StudyCurve A, B, I;
    explicit Currents(const TrialResult& response) : A(response.probes.at("I_A")), B(response.probes.at("I_B")), I(A) {
        for (std::size_t k = 0; k < I.y.size(); ++k) I.y[k] += B.y[k];
    }
};

/// Charge (coulombs) of the part of the current that exceeds the leak, in a window.
double net_charge(const StudyCurve& current, const TimeWindow& window) {
    const auto part = current.between(window.from, window.to);
    double out = 0;
    for (std::size_t k = 1; k < part.x.size(); ++k)
        out += (part.x[k] - part.x[k - 1]) * std::max((part.y[k] + part.y[k - 1]) / 2 - leak, 0.0);
    return out;
}

/// The exact response of fa1 to the press stimulus.
Result<TrialResult> simulate(const std::vector<std::string>& settings, double rate = 10e3) {
    return run_trial({.afferent = "fa1", .settings = settings, .rate = rate, .probes = {"I_A", "I_B", "u"}});
}

void report_currents(StudyResult& out, const Currents& i, const StudyCurve& force) {
    bool exclusive = true;
    for (std::size_t k = 0; k < i.A.y.size(); ++k) exclusive = exclusive && (i.A.y[k] == 0 || i.B.y[k] == 0);
    out.claim_true("I is I_A while the filtered force is positive and I_B while it is negative", exclusive, "thesis 3.4, fig. 18a");
    const double up = i.A.max(), down = i.B.max();
    out.claim("largest I_A", up, "A"), out.claim("largest I_B", down, "A");
    auto& ratio = out.claim("largest I_A over largest I_B", up / down).derived_as(3.5 / 2.75, "thesis 3.4: k_A and k_B");
    if (ratio.needs_explanation())
        ratio.explain("the filter still holds charge from the rise when the force begins to fall, which reduces I_B");
    out.claim("largest I_A over largest I_B, both minus the leak", (up - leak) / (down - leak))
        .derived_as(3.5 / 2.75, "thesis 3.4: k_A and k_B");
    out.claim("I_A: delay of its peak after the peak of the slope", i.A.x_of_max() - force.slope().x_of_max(), "s")
        .allow_min(1e-3, "thesis 3.4: slightly delayed in protraction; at least one sample of 1 ms");
    out.claim("I stays above the leak after protraction for", i.A.crossing(leak, i.A.x_of_max()) - press::protraction.to, "s");
    out.claim("I stays above the leak after retraction for", i.B.crossing(leak, i.B.x_of_max()) - press::retraction.to, "s");
    out.claim("charge above the leak in protraction", net_charge(i.I, press::protraction), "C");
    out.claim("upper limit of theta - u_rest for a discharge in protraction", net_charge(i.I, press::protraction) / C, "V");
    out.plot("Receptor currents", "time (s)", "current (uA)")
        .add("I", i.I.scaled(1, 1e6))
        .add("I_A", i.A.scaled(1, 1e6))
        .add("I_B", i.B.scaled(1, 1e6))
        .describe_published("two components with unequal peaks, one in protraction and one in retraction");
}

/// Claims that the train has spikes in protraction and retraction only. `why` explains the claims that do not hold.
void report_train(StudyResult& out, const std::string& name, const std::vector<double>& train, const char* why) {
    out.claim(name + ": discharges in protraction", press::spike_count(train, press::protraction), "spikes")
        .allow_min(1, "thesis 3.4, fig. 18c");
    out.claim(name + ": discharges in retraction", press::spike_count(train, press::retraction), "spikes")
        .allow_min(1, "thesis 3.4, fig. 18c");
    out.claim(name + ": discharges in plateau and after",
              press::spike_count(train, press::plateau) + press::spike_count(train, press::after), "spikes")
        .allow_range(0, 0, "thesis 1.2: only in protraction and retraction");
    for (auto c = out.claims.end() - 3; c != out.claims.end(); ++c)
        if (c->needs_explanation()) c->explain(why);
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    const auto response = simulate({}), with_fig16_threshold = simulate({"fa1.V_th=1", "fa1.V_reset=0.5"}),
               with_20_Hz = simulate({"fa1.f=20"}),
               with_20_Hz_and_gain = simulate({"fa1.f=20", "fa1.k_A=35e-6", "fa1.k_B=27.5e-6", "fa1.V_th=1", "fa1.V_reset=0.5"});
    for (const auto* t : {&response, &with_fig16_threshold, &with_20_Hz, &with_20_Hz_and_gain})
        if (!*t) return t->error();
    const auto algorithm = simulate_train(press::thesis_algorithm("fa1"));
    if (!algorithm) return algorithm.error();
    const auto force = press::force_curve(1e-4);
    if (!force) return force.error();
    if (auto ok = options.report_progress(0.8); !ok) return ok.error();
    const Currents i(*response);
    report_currents(out, i, *force);
    const double up = measure<PeakRate>(response->spikes, rising), down = measure<PeakRate>(response->spikes, falling);
    out.claim("peak of the frequency while the force rises", up, "Hz"),
        out.claim("peak of the frequency while the force falls", down, "Hz");
    out.claim("peak of the frequency, rising over falling force", up / down)
        .allow_min(1, "thesis 1.2 and 3.4: asymmetrical, protraction above retraction");
    report_train(
        out, "f = 2 Hz as printed, theta 0.5 V", response->spikes,
        "the charge of a filter of 2 Hz at the end of a ramp keeps the current above the leak after the ramp has ended (errata B13)");
    report_train(
        out, "theta 1 V and u_rst 0.5 V as in fig. 16", with_fig16_threshold->spikes,
        "the charge above the leak in protraction is less than C times 1 V (errata B10a), so the first discharge falls in the plateau");
    report_train(out, "f = 20 Hz", with_20_Hz->spikes, "with the published gains the current hardly exceeds the leak (errata B13)");
    report_train(out, "f = 20 Hz, ten times the gains, theta as in fig. 16", with_20_Hz_and_gain->spikes, "reason unknown");
    out.plot("Membrane", "time (s)", "u (V)")
        .add("theta 0.5 V, u_rst 0.25 V", response->probes.at("u"))
        .add("1 and 0.5 V", with_fig16_threshold->probes.at("u"));
    out.plot("Instantaneous frequency", "time (s)", "frequency (Hz)")
        .points("T = 1 ms", press::frequency_at_start(*algorithm))
        .points("exact solution", press::frequency_at_start(response->spikes))
        .add("force, 10 Hz per newton", force->scaled(1, 10))
        .describe_published(
            "in protraction, slightly late, and in retraction; \"the maximum amplitude for the protraction and retraction phase matches\" "
            "the data, which are lost");
    return out;
}

const Study study{"fig18", "The FA-I model under the press stimulus",
                  "Currents I_A and I_B, membrane, and instantaneous frequency: discharges in protraction and retraction with unequal "
                  "peaks, those in protraction slightly late. Thesis 3.4, fig. 18",
                  compute};

}  // namespace corpuscle::studies::fig18
