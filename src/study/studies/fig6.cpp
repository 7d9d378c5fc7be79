// Thesis fig. 6, a against b: the model behind a converter, and the model as transistors, both from the same sensor and under the same
// press.

#include <fmt/format.h>

#include "study/apart.hpp"
#include "study/studies.hpp"
#include "study/thesis/press.hpp"

namespace corpuscle::studies::fig6 {

struct Way {
    const char *name, *words;
};
struct Class {
    const char* model;
    std::vector<Way> ways;
};
const Class classes[] = {{"sa1",
                          {{"fsr+f2v+adc+sa1", "a: sensor, transducer, converter (12 bits, 1 kHz), words"},
                           {"sa1-macro", "b of ideal blocks"},
                           {"sa1-circuit", "b, the chip"}}},
                         {"fa1",
                          {{"fsr+f2v+adc+fa1", "a: sensor, transducer, converter (12 bits, 1 kHz), words"},
                           {"fa1-macro", "b of ideal blocks"},
                           {"fa1-circuit", "b, the chip"}}}};

/// Its spikes beside the model's, phase by phase.
Result<void> tell(Outcome& out, Plot& rows, const Way& way, const std::vector<double>& model) {
    const auto train = train_of({way.name});
    if (!train) return train.error();
    const auto far = apart(model, *train);
    if (!far) return far.error();
    const auto named = [&](const char* what) { return fmt::format("{}: {}", way.name, what); };
    const auto because =
        fmt::format("{}; {} spikes: {}; the model's {}", way.words, way.name, press::pattern(*train), press::pattern(model));
    out.claim(named("spikes beside the model's"), static_cast<double>(train->size()) / static_cast<double>(model.size())).because(because);
    out.claim(named("rms of what its spikes are off"), far->rms, "s")
        .because(fmt::format("{:g} spikes without a partner within 50 ms", far->unmatched));
    out.claim(named("median of what they are late"), far->median, "s");
    rows.row(way.name, *train);
    return {};
}

/// One converter for ten sensors: each is converted at a tenth of the rate (how late each channel is besides is left out).
Result<void> tell_shared(Outcome& out) {
    const std::string name = "fsr+f2v+adc+sa1";
    const auto alone = train_of({name});
    const auto slow = train_of({name, "press", {name + ".f_s=100"}});
    if (!alone) return alone.error();
    if (!slow) return slow.error();
    const auto far = apart(*alone, *slow);
    if (!far) return far.error();
    out.claim("a converter of 1 kHz shared by ten sensors: rms of what the spikes move", far->rms, "s")
        .because(fmt::format("each is converted at 100 Hz then; {:g} spikes lose their partner", far->unmatched));
    return {};
}

Result<Outcome> work(const StudyOptions& options) {
    Outcome out;
    double done = 0;
    for (const auto& c : classes) {
        const auto model = train_of({c.model});
        if (!model) return model.error();
        Plot rows{fmt::format("{}: spikes under the press", c.model), "time (s)", "", {}};
        rows.row(c.model, *model);
        for (const auto& way : c.ways) {
            if (auto ok = tell(out, rows, way, *model); !ok) return ok.error();
            if (auto ok = options.at(done += 1.0 / 7); !ok) return ok.error();
        }
        const auto n = out.claims.size();
        out.finds(fmt::format("{}: the digital way is nearer to the model's times than the chip", c.model),
                  out.claims[n - 8].made < out.claims[n - 2].made,
                  "thesis 1.3: analog blocks depend on their accuracy, linearity and noise");
        out.plots.push_back(rows);
    }
    if (auto ok = tell_shared(out); !ok) return ok.error();
    out.note(
        "Values of the converter are a choice; in study resolution they are varied. The chips' gains are not the model's (errata S9a, S10, "
        "S15), so "
        "what they are off is design more than accuracy; mismatch and noise are left out here.");
    out.note(
        "That processing in parallel needs small and frugal units, that a calibration would be needed, and which way the brain would "
        "rather have is "
        "not decided by spikes under one press; power and area of the chips stand in doc/chips.md.");
    return out;
}

const Study study{"fig6", "The mixed-signal way against the analog one",
                  "(a) converts, processes in words, and converts back; (b) stays analog. The first loses resolution by conversion, the "
                  "second depends on "
                  "the accuracy of its blocks. Thesis 1.3, fig. 6",
                  work};

}  // namespace corpuscle::studies::fig6
