// Thesis fig. 3: the four classes under a step. Slowly adapting ones fire through the hold, fast adapting ones at its edges; type I
// irregularly or by strength, type II evenly or to vibration. The figure shows shapes and no numbers.

#include "measure/measures.hpp"
#include "study/studies.hpp"
#include "study/trains.hpp"

namespace corpuscle::studies::fig3 {

constexpr double on = 0.25, off = 0.75, later = 0.5;  // s: the step, its end, and when only the hold is left

double count(const std::vector<double>& train, double from, double to) { return measure<SpikeCount>(train, {from, to}); }

Result<Outcome> work(const StudyOptions& options) {
    Outcome out;
    const Asked step{"sa1", "step", {"step.F_max=4N"}};
    const auto touch = touch_of(step);
    if (!touch) return touch.error();
    Plot force{"The step", "time (s)", "force (N)", {{"force", {}, touch->force, Plot::Style::line}}};
    for (std::size_t k = 0; k < touch->force.size(); ++k) force.series[0].x.push_back(touch->clock.time(static_cast<std::int64_t>(k)));
    Plot spikes{"Spikes of the four classes", "time (s)", "", {}};
    double done = 0;
    const double none = std::numeric_limits<double>::quiet_NaN();
    for (const auto& [name, holds] : {std::pair{"sa1", true}, {"sa2", true}, {"fa1", false}, {"fa2", false}}) {
        auto asked = step;
        asked.afferent = name;
        const auto train = train_of(asked);
        if (!train) return train.error();
        const std::string source = "thesis fig. 3, its shape";
        out.claims.push_back(
            {std::string(name) + ": spikes in the first 250 ms of the step", count(*train, on, later), "", none, 1, none, source});
        out.claims.push_back({std::string(name) + ": spikes in its last 250 ms", count(*train, later, off), "", none, holds ? 2.0 : 0.0,
                              holds ? none : 0.0, source});
        out.claims.push_back({std::string(name) + ": spikes within 100 ms of its end", count(*train, off, off + 0.1), "", none,
                              holds ? none : 1.0, none, source});
        spikes.series.push_back({name, *train, {}, Plot::Style::raster});
        if (!options.keep_on(done += 0.25)) return Error{Code::interrupted, "interrupted"};
    }
    out.plots = {std::move(force), std::move(spikes)};
    out.notes = {
        "A step has no slope that a sensor could show; these rise within one sample of 0.1 ms. What SA-II makes of the step's end is "
        "the |F'| of SA-IA, which the thesis calls more suitable to SA-II (3.1).",
        "Values of sa2 and fa2 are a choice: the thesis has none."};
    return out;
}

const Study study{"fig3", "The four classes of the skin under a step", "Which fire at the step, which through the hold? Thesis fig. 3",
                  work};

}  // namespace corpuscle::studies::fig3
