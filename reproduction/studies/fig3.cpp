// Thesis fig. 3: the four afferent classes under a step of force. The text describes the shapes; the figure has no numbers.

#include <fmt/format.h>
#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/press.hpp"

namespace corpuscle::studies::fig3 {

constexpr double on = 0.25, off = 0.75;  // s: start and end of the step
constexpr TimeWindow onset{on, on + 0.1}, last{0.5, off},
    removal{off, 1.0};  // s: windows for the bursts at onset and removal, and the second half of the step
constexpr auto source = "thesis 1.2, fig. 3";

struct Class {
    const char *name, *full_name;
    bool slowly_adapting;
    double threshold;  // N, median of the nerve's afferents of this class; from memory
};
constexpr Class classes[] = {
    {"sa1", "SA-I", true, 1.3e-3}, {"sa2", "SA-II", true, 7.5e-3}, {"fa1", "FA-I", false, 0.58e-3}, {"fa2", "FA-II", false, 0.54e-3}};

/// Spike times (s) under a step of this force (N).
Result<std::vector<double>> simulate_step(const char* afferent, double force) {
    return simulate_train({afferent, "step", {fmt::format("step.F_max={}", force)}});
}

/// The smallest step that evokes a spike (N), by bisection on a logarithmic scale.
Result<double> smallest_step(const char* afferent) {
    double low = 1e-4, high = 4;
    for (int k = 0; k < 10; ++k) {
        const double middle = std::sqrt(low * high);
        const auto train = simulate_step(afferent, middle);
        if (!train) return train.error();
        (train->empty() ? low : high) = middle;
    }
    return high;
}

void add_claims(StudyResult& out, const Class& c, const std::vector<double>& train) {
    const auto spikes = [&](const char* when, const TimeWindow& window) -> Claim& {
        return out.claim(fmt::format("{}: {}", c.full_name, when), press::spike_count(train, window), "spikes");
    };
    spikes("within 100 ms of the onset (two make a burst)", onset).allow_min(2, source);
    auto& during_hold = spikes("in the last 250 ms of the step", last);
    c.slowly_adapting ? during_hold.allow_min(2, fmt::format("{}: a sustained discharge", source))
                      : during_hold.allow_range(0, 0, fmt::format("{}: only at onset and removal", source));
    auto& after_removal = spikes("after the removal", removal);
    if (!c.slowly_adapting) after_removal.allow_min(2, fmt::format("{}: a burst at the removal", source));
}

/// Peak frequency after the onset over the last frequency of the step.
double onset_ratio(const std::vector<double>& train) { return measure<PeakRate>(train, onset) / measure<LastRate>(train, last); }

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    const auto stimulus = trial_force({"sa1", "step", {"step.F_max=4"}});
    if (!stimulus) return stimulus.error();
    StudyPlot spikes{"Spikes of the four classes", "time (s)", "", {}};
    std::vector<double> onset_ratios;  // of SA-I and SA-II, in this order
    for (const auto& c : classes) {
        const auto train = simulate_step(c.name, 4);
        if (!train) return train.error();
        add_claims(out, c, *train);
        spikes.raster_row(c.full_name, *train);
        if (c.slowly_adapting) onset_ratios.push_back(onset_ratio(*train));
    }
    for (const auto& c : classes) {
        const auto smallest = smallest_step(c.name);
        if (!smallest) return smallest.error();
        press::set_reference(out.claim(fmt::format("{}: smallest step that evokes a spike", c.full_name), *smallest, "N"), c.threshold,
                             "median threshold of the nerve's afferents, from memory, not verified");
        if (auto ok = options.report_progress(static_cast<double>(&c - classes + 1) / 5); !ok) return ok.error();
    }
    out.claim_true(
        fmt::format("type I has the larger ratio of the onset's frequency to that at the end of the step: SA-I {:.2g}, SA-II {:.2g}",
                    onset_ratios[0], onset_ratios[1]),
        onset_ratios[0] > onset_ratios[1], source);
    out.plot("The step", "time (s)", "force (N)").add("force", stimulus->curve());
    out.plots.push_back(spikes.describe_published(
        "slowly adapting classes fire as long as the skin is pressed, fast adapting classes at onset and removal"));
    out.note(
        "The thesis separates type I from type II by the ratio of onset to sustained discharge. The literature it cites uses the receptive "
        "field: small and sharp for type I, large and diffuse for type II (errata B18). A single afferent cannot show that.");
    out.note(
        "The abstract of Vallbo and Johansson gives four classes and 17,000 afferents in the glabrous hand. The proportions 43 % FA-I, 25 "
        "% SA-I, 13 % FA-II and 19 % SA-II are from memory, not verified.");
    out.note(
        "The models are made for forces of 0.2 to 4 N. Their leak is a fraction of the current at these forces, so a step that evokes a "
        "spike must be far larger than for the nerve's afferents.");
    out.note(
        "The parameters of sa2 and fa2 are our choice; the thesis has none. Without noise all classes fire regularly. The spikes of SA-II "
        "at the end of the step come from the |F'| of SA-IA, which the thesis finds more suitable to SA-II (3.1). The step rises within "
        "one sample, 0.1 ms.");
    return out;
}

const Study study{"fig3", "The four afferent classes under a step of force",
                  "Slowly adapting classes fire as long as the skin is pressed, fast adapting ones only at onset and removal. Onset and "
                  "hold frequency differ much for type I and little for type II. Thesis 1.2, fig. 3",
                  compute};

}  // namespace corpuscle::studies::fig3
