// Thesis fig. 5: the nerve's instantaneous discharge frequency under the press stimulus. The curves are lost. The models are compared with
// the text, and with reference values whose reliability is stated.

#include <fmt/format.h>

#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/press.hpp"

namespace corpuscle::studies::fig5 {

using press::spike_count;

constexpr auto source = "thesis 1.2, fig. 5";
constexpr auto inferred = "Birznieks et al. 2001, population mean, inferred from the thesis's parameters, not read in the paper";

/// True if each value is smaller than the one before.
bool is_falling(const StudyCurve& line) {
    for (std::size_t k = 1; k < line.y.size(); ++k)
        if (line.y[k] >= line.y[k - 1]) return false;
    return true;
}

void add_sa1_claims(StudyResult& out, const std::vector<double>& train) {
    const double peak = measure<PeakRate>(train, press::protraction), last = measure<LastRate>(train, press::plateau);
    const auto plateau = press::frequency_at_start(train).between(press::plateau.from, press::plateau.to);
    press::set_reference(out.claim("SA-I: peak in protraction", peak, "Hz"), 38, inferred);
    press::set_reference(out.claim("SA-I: first frequency of the plateau", plateau.y.front(), "Hz"), 30, inferred);
    press::set_reference(out.claim("SA-I: last frequency of the plateau", last, "Hz"), 15, inferred);
    out.claim("SA-I: peak over the last frequency of the plateau", peak / last)
        .allow_range(2, 3, "thesis 1.2: high, then sustained; the range is our choice");
    out.claim_true("SA-I: frequency falls steadily through the plateau", is_falling(plateau), source);
    out.claim("SA-I: spikes after 40 % of retraction", spike_count(train, {0.675, 0.75}), "spikes")
        .allow_max(1, "thesis 1.2: almost no response; the number is our choice");
}

void add_fa1_claims(StudyResult& out, const std::vector<double>& train) {
    const double up = measure<PeakRate>(train, {0.25, 0.5}), down = measure<PeakRate>(train, {0.625, 1.0});
    press::set_reference(out.claim("FA-I: peak of the rising force", up, "Hz"), 25, inferred);
    press::set_reference(out.claim("FA-I: peak of the falling force", down, "Hz"), 19, inferred);
    out.claim("FA-I: peak of the rising over peak of the falling force", up / down)
        .allow_range(1.2, 1.5, "thesis 1.2: asymmetrical, protraction above retraction; the range is our choice");
    out.claim("FA-I: spikes in the plateau's last 100 ms", spike_count(train, press::plateau_end), "spikes").allow_range(0, 0, source);
    const double other_spikes = spike_count(train, press::plateau) + spike_count(train, press::after);
    auto& c = out.claim("FA-I: spikes outside protraction and retraction", other_spikes, "spikes")
                  .allow_range(0, 0, fmt::format("{}: spikes only in protraction and retraction", source));
    if (c.needs_explanation())
        c.explain(
            "the corner frequency of the filter is 2 Hz, and the charge it holds at the end of a ramp keeps driving the neuron (errata "
            "B13)");
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    const auto sa1 = simulate_train({"sa1"}), fa1 = simulate_train({"fa1"});
    const auto force = press::force_curve(1e-3);
    if (!sa1) return sa1.error();
    if (!fa1) return fa1.error();
    if (!force) return force.error();
    if (auto ok = options.report_progress(0.5); !ok) return ok.error();
    add_sa1_claims(out, *sa1), add_fa1_claims(out, *fa1);
    const auto at_interval_start = press::frequency_at_start(*sa1), at_interval_end = press::frequency_at_end(*sa1);
    out.claim("SA-I: time of the peak, frequency at the start of each interval", at_interval_start.x_of_max(), "s");
    out.claim("SA-I: time of the peak, frequency at the end of each interval", at_interval_end.x_of_max(), "s");
    for (const auto& [name, train] : {std::pair{"SA-I", &*sa1}, {"FA-I", &*fa1}})
        out.plot(fmt::format("{}: instantaneous frequency", name), "time (s)", "frequency (Hz)")
            .points("at the first spike of the interval", press::frequency_at_start(*train))
            .points("at the second spike of the interval", press::frequency_at_end(*train))
            .add("force, 10 Hz per newton", force->scaled(1, 10))
            .describe_published(name == std::string_view("SA-I")
                                    ? "high in protraction, sustained and slowly decaying in the plateau, almost nothing in retraction"
                                    : "discharges in protraction and retraction only, with unequal peaks");
    out.note(
        "The thesis plots a frequency at the spike that begins the interval (3.3), so the last spike has none (errata B14); many tools "
        "plot it at the spike that ends it. Here an interval that begins in protraction and ends in the plateau counts as protraction.");
    out.note(
        "Frequencies are proportional to 1 / (theta - u_rst), which is not published: 0.25 V is our choice (errata B10a). Single afferents "
        "at 4 N peak at 50 to 150 Hz, and SA-I sustains 20 to 50 Hz; from memory, not verified.");
    out.note(
        "The paper's abstract says that nearly all of the 196 afferents responded. Their numbers, 73 SA-I, 41 SA-II, 72 FA-I and 10 FA-II, "
        "are from memory, not verified. The paper's curves are population means; one model of one afferent has no spread.");
    return out;
}

const Study study{"fig5", "Instantaneous discharge frequency under the press stimulus",
                  "SA-I: high in protraction, sustained but slowly decaying in the plateau, almost none in retraction. FA-I: unequal "
                  "discharges in protraction and retraction only. Thesis 1.2, fig. 5, after Birznieks et al. 2001",
                  compute};

}  // namespace corpuscle::studies::fig5
