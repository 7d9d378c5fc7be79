// Thesis fig. 6, (a) against (b): the model behind an analog-to-digital converter, and the model as transistors, with the same sensor and
// the press stimulus.

#include <fmt/format.h>

#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/press.hpp"
#include "reproduction/thesis/spike_timing_error.hpp"

namespace corpuscle::studies::fig6 {

struct Implementation {
    const char *name, *description;
};
/// An afferent type: its model, and its implementations from digital to the chip. compute() relies on this order.
struct Class {
    const char* model;
    std::vector<Implementation> implementations;
};
const Class classes[] = {{"sa1",
                          {{"fsr+f2v+adc+sa1", "(a): sensor, transducer, converter (12 bits, 1 kHz), fixed-point model"},
                           {"sa1-macro", "(b) of ideal blocks"},
                           {"sa1-circuit", "(b), the chip"}}},
                         {"fa1",
                          {{"fsr+f2v+adc+fa1", "(a): sensor, transducer, converter (12 bits, 1 kHz), fixed-point model"},
                           {"fa1-macro", "(b) of ideal blocks"},
                           {"fa1-circuit", "(b), the chip"}}}};

/// Compares the spikes of an implementation with those of the model. Adds three claims; the second is the rms error.
Result<void> add_comparison(StudyResult& out, StudyPlot& raster, const Implementation& implementation, const std::vector<double>& model) {
    const auto train = simulate_train({implementation.name});
    if (!train) return train.error();
    const auto timing_error = spike_timing_error(model, *train);
    if (!timing_error) return timing_error.error();
    const auto named = [&](const char* quantity) { return fmt::format("{}: {}", implementation.name, quantity); };
    const auto explanation = fmt::format("{}; spikes at rest, in protraction, plateau, retraction and after: {}, of the model {}",
                                         implementation.description, press::phase_counts(*train), press::phase_counts(model));
    out.claim(named("number of spikes over the model's"), static_cast<double>(train->size()) / static_cast<double>(model.size()))
        .explain(explanation);
    out.claim(named("rms error of spike times"), timing_error->rms, "s")
        .explain(fmt::format("{:g} spikes of the two trains have no partner within 50 ms", timing_error->unmatched));
    out.claim(named("median delay of spikes"), timing_error->median, "s");
    raster.raster_row(implementation.name, *train);
    return {};
}

/// One converter for ten sensors: each sensor is converted at a tenth of the rate. The delays between the sensors' conversions are left
/// out.
Result<void> add_shared_converter(StudyResult& out) {
    const std::string name = "fsr+f2v+adc+sa1";
    const auto single = simulate_train({name});
    const auto shared = simulate_train({name, "press", {name + ".f_s=100"}});
    if (!single) return single.error();
    if (!shared) return shared.error();
    const auto timing_error = spike_timing_error(*single, *shared);
    if (!timing_error) return timing_error.error();
    out.claim("a converter of 1 kHz shared by ten sensors: rms change of spike times", timing_error->rms, "s")
        .explain(fmt::format("each sensor is then converted at 100 Hz; {:g} spikes of the two trains have no partner within 50 ms",
                             timing_error->unmatched));
    return {};
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    double done = 0;
    for (const auto& c : classes) {
        const auto model = simulate_train({c.model});
        if (!model) return model.error();
        StudyPlot raster{fmt::format("{}: spikes under the press stimulus", c.model), "time (s)", "", {}};
        raster.raster_row(c.model, *model);
        for (const auto& implementation : c.implementations) {
            if (auto ok = add_comparison(out, raster, implementation, *model); !ok) return ok.error();
            if (auto ok = options.report_progress(done += 1.0 / 7); !ok) return ok.error();
        }
        // Each of the three implementations has three claims, so n - 8 is the rms error of the first one and n - 2 that of the last.
        const auto n = out.claims.size();
        out.claim_true(
            fmt::format("{}: spike times of the digital implementation are closer to the model's than those of the chip", c.model),
            out.claims[n - 8].computed < out.claims[n - 2].computed,
            "thesis 1.3: analog blocks depend on their accuracy, linearity and noise");
        out.plots.push_back(raster);
    }
    if (auto ok = add_shared_converter(out); !ok) return ok.error();
    out.note(
        "The converter's parameters are our choice; the study resolution varies them. The chips' gains are not the model's (errata S9a, "
        "S10, S15), so their error comes more from the design than from its accuracy. Mismatch and noise are left out here.");
    out.note(
        "Spikes under one stimulus do not decide whether parallel processing needs small, low-power circuits, whether calibration is "
        "needed, or which approach is closer to the brain. doc/chips.md has power and area of the chips.");
    return out;
}

const Study study{"fig6", "Mixed-signal against analog implementation",
                  "(a) converts the signal, processes it digitally, and converts back; (b) stays analog. The first loses resolution by "
                  "conversion, the second depends on the accuracy of its blocks. Thesis 1.3, fig. 6",
                  compute};

}  // namespace corpuscle::studies::fig6
