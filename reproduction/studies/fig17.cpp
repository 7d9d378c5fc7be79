// Thesis fig. 17: the SA-I model under the press stimulus, at the thesis's 1 ms and with the exact solution.

#include <fmt/format.h>
#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/press.hpp"

namespace corpuscle::studies::fig17 {

/// Three possible pairs of the threshold theta and the reset voltage u_rst (V), which are not published (errata B10a).
struct ThresholdCase {
    const char* name;
    double theta, reset;
};
constexpr ThresholdCase threshold_cases[] = {
    {"1 and 0.5 V as in fig. 16", 1, 0.5}, {"0.5 and 0.25 V (our choice)", 0.5, 0.25}, {"0.2 and 0 V", 0.2, 0}};

/// Sum of two curves with the same x.
StudyCurve sum(const StudyCurve& a, const StudyCurve& b) {
    StudyCurve out = a;
    for (std::size_t k = 0; k < a.y.size(); ++k) out.y[k] += b.y[k];
    return out;
}
StudyCurve positive(StudyCurve a) {
    for (double& y : a.y) y = std::max(y, 0.0);
    return a;
}

/// The receptor's currents I_A, I_B, I_C, and their sum I without negative I_B and I_C.
struct Currents {
    StudyCurve A, B, C, I;
    explicit Currents(const TrialResult& response)
        : A(response.probes.at("I_A")), B(response.probes.at("I_B")), C(response.probes.at("I_C")),
          I(sum(A, sum(positive(B), positive(C)))) {}
};

void report_currents(StudyResult& out, const Currents& i, const StudyCurve& force) {
    const auto source = "thesis 3.3, fig. 17a";
    double worst_error = 0;
    for (std::size_t k = 0; k < force.y.size(); ++k) worst_error = std::max(worst_error, std::abs(i.A.y[k] / 1e-6 - force.y[k]));
    out.claim("I_A / k_A: largest difference from the force", worst_error, "N")
        .allow_max(1e-9, "thesis 3.3: I_A is an exact copy of the force");
    const double peak_delay = i.B.x_of_max() - force.slope().x_of_max();
    out.claim("I_B: delay of its peak after the peak of the slope", peak_delay, "s")
        .allow_range(0, 10e-3, "thesis 3.3: proportional to the derivative; the range is our choice, the filter's time constant is 8 ms");
    out.claim("I_B: peak over that of a derivative with the same gain", i.B.max() / (8e-6 / (2 * M_PI * 20) * force.slope().max()))
        .allow_range(0.9, 1.1, "thesis 3.3: proportional to the derivative; a tenth is our choice");
    const double w = 2 * M_PI * 4, corner = 2 * M_PI * 20;  // the half-cosine of 125 ms is half a period of 4 Hz
    out.claim("high-pass of 20 Hz at 4 Hz: amplitude below a derivative's", 100 * (1 - corner / std::hypot(w, corner)), "%");
    out.claim("high-pass of 20 Hz at 4 Hz: phase lag behind a derivative", std::atan(w / corner) * 180 / M_PI, "degrees");
    const double from = press::plateau.from + 50e-3, to = press::plateau.to - 1e-3;  // I_B has decayed by then
    out.claim("fraction of the decay of I in the plateau that is due to I_C, from 50 ms on",
              100 * (i.C.at(from) - i.C.at(to)) / (i.I.at(from) - i.I.at(to)), "%")
        .allow_range(95, 105, "thesis 3.3: I_C is responsible for the slow decay; the range is our choice");
    const double t = (press::retraction.from + press::retraction.to) / 2 + 20e-3;
    out.claim("I_B + I_C late in retraction (20 ms after its middle), before rectification", i.B.at(t) + i.C.at(t), "A")
        .allow_max(0, "thesis 3.3: negative while the force falls");
    out.claim("contribution of I_B and I_C to I late in retraction", i.I.at(t) - i.A.at(t), "A")
        .allow_range(0, 0, "thesis 3.3: negative values do not contribute");
    out.claim("I: largest value", i.I.max(), "A");
    out.plot("Receptor currents, T = 1 ms", "time (s)", "current (uA)")
        .add("I", i.I.scaled(1, 1e6))
        .add("I_A", i.A.scaled(1, 1e6))
        .add("I_B", i.B.scaled(1, 1e6))
        .add("I_C", i.C.scaled(1, 1e6))
        .describe_published(fmt::format(
            "{}: I_A a copy of the force, I_B its derivative, I_C a slow decay; I is their sum without negative values", source));
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    auto spec = press::thesis_algorithm("sa1");
    spec.probes = {"I_A", "I_B", "I_C", "u"};
    const auto response = run_trial(spec);
    if (!response) return response.error();
    const auto force = press::force_curve(1e-3);
    if (!force) return force.error();
    report_currents(out, Currents(*response), *force);
    out.plot("Membrane, T = 1 ms", "time (s)", "u (V)").add("u", response->probes.at("u"));

    StudyPlot frequencies{"Instantaneous frequency", "time (s)", "frequency (Hz)", {}};
    for (const auto& r : threshold_cases) {
        const std::vector<std::string> set = {fmt::format("sa1.V_th={}", r.theta), fmt::format("sa1.V_reset={}", r.reset)};
        const auto algorithm = simulate_train(press::thesis_algorithm("sa1", set)), exact = simulate_train({"sa1", "press", set});
        if (!algorithm) return algorithm.error();
        if (!exact) return exact.error();
        if (auto ok = options.report_progress(static_cast<double>(&r - threshold_cases + 1) / 4); !ok) return ok.error();
        const auto named = [&](const char* quantity) { return fmt::format("theta, u_rst {}: {}", r.name, quantity); };
        const auto f = press::frequency_at_start(*exact), plateau = f.between(press::plateau.from, press::plateau.to);
        out.claim(named("peak of the frequency"), measure<PeakRate>(*exact, press::protraction), "Hz");
        out.claim(named("first frequency of the plateau"), plateau.y.front(), "Hz");
        out.claim(named("last frequency of the plateau"), measure<LastRate>(*exact, press::plateau), "Hz");
        out.claim_true(named("frequency highest in protraction, and higher at the start of the plateau than at its end"),
                       f.x_of_max() < press::protraction.to && plateau.y.front() > plateau.y.back(), "thesis 1.2 and 3.3, fig. 17c");
        out.claim(named("spikes after 40 % of retraction"), press::spike_count(*exact, {0.675, 0.75}), "spikes")
            .allow_max(1, "thesis 1.2: almost no response; the number is our choice");
        double worst_difference = algorithm->size() == exact->size() ? 0 : Claim::none;
        for (std::size_t k = 0; k < std::min(algorithm->size(), exact->size()); ++k)
            worst_difference = std::max(worst_difference, std::abs((*algorithm)[k] - (*exact)[k]));
        auto& c = out.claim(named("largest spike time difference between T = 1 ms and the exact solution"), worst_difference, "s");
        if (std::isnan(worst_difference)) c.explain("T = 1 ms and the exact solution give different numbers of spikes");
        frequencies.points(r.name, press::frequency_at_start(*algorithm));
    }
    out.plots.push_back(frequencies.describe_published("points, one per discharge, close to the curve of the nerve (which is lost)"));
    out.note(
        "theta, u_rst and the curve of fig. 17c are not in the text, so only the shape of the frequency can be checked. It is plotted at "
        "the spike that begins the interval.");
    return out;
}

const Study study{
    "fig17", "The SA-I model under the press stimulus",
    "Currents I_A, I_B, I_C and their sum, membrane, and instantaneous frequency at T = 1 ms; \"a similar response to the data\". "
    "Thesis 3.3, fig. 17",
    compute};

}  // namespace corpuscle::studies::fig17
