// Thesis fig. 3: the four classes under a step. Its shapes are told in words; its picture has no numbers.

#include <fmt/format.h>
#include <cmath>

#include "study/studies.hpp"
#include "study/thesis/press.hpp"

namespace corpuscle::studies::fig3 {

constexpr double on = 0.25, off = 0.75;                                    // s: the step and its end
constexpr Stretch onset{on, on + 0.1}, last{0.5, off}, removal{off, 1.0};  // what is taken for a burst's place, and for "still pressed"
constexpr auto words = "thesis 1.2, fig. 3";

struct Class {
    const char *name, *full;
    bool slow;
    double threshold;  // N, of the nerve, median
};
constexpr Class classes[] = {
    {"sa1", "SA-I", true, 1.3e-3}, {"sa2", "SA-II", true, 7.5e-3}, {"fa1", "FA-I", false, 0.58e-3}, {"fa2", "FA-II", false, 0.54e-3}};

Result<std::vector<double>> under_step(const char* afferent, double force) {
    return train_of({afferent, "step", {fmt::format("step.F_max={}", force)}});
}

/// The least step that is answered with a spike; N, by halving in ratio.
Result<double> least_step(const char* afferent) {
    double low = 1e-4, high = 4;
    for (int k = 0; k < 10; ++k) {
        const double middle = std::sqrt(low * high);
        const auto train = under_step(afferent, middle);
        if (!train) return train.error();
        (train->empty() ? low : high) = middle;
    }
    return high;
}

void tell(Outcome& out, const Class& c, const std::vector<double>& train) {
    const auto spikes = [&](const char* when, const Stretch& s) -> Claim& {
        return out.claim(fmt::format("{}: {}", c.full, when), press::count(train, s), "spikes");
    };
    spikes("within 100 ms of the onset, two are a burst", onset).at_least(2, words);
    auto& held = spikes("in the step's last 250 ms", last);
    c.slow ? held.at_least(2, fmt::format("{}: a sustained discharge", words))
           : held.between(0, 0, fmt::format("{}: only at onset and removal", words));
    auto& gone = spikes("after the removal", removal);
    if (!c.slow) gone.at_least(2, fmt::format("{}: a burst at the removal", words));
}

/// Frequency just after the onset over that of the hold.
double contrast(const std::vector<double>& train) { return measure<PeakRate>(train, onset) / measure<LastRate>(train, last); }

Result<Outcome> work(const StudyOptions& options) {
    Outcome out;
    const auto touch = touch_of({"sa1", "step", {"step.F_max=4"}});
    if (!touch) return touch.error();
    Plot spikes{"Spikes of the four classes", "time (s)", "", {}};
    std::vector<double> contrasts;
    for (const auto& c : classes) {
        const auto train = under_step(c.name, 4);
        if (!train) return train.error();
        tell(out, c, *train);
        spikes.row(c.full, *train);
        if (c.slow) contrasts.push_back(contrast(*train));
    }
    for (const auto& c : classes) {
        const auto least = least_step(c.name);
        if (!least) return least.error();
        press::known_as(out.claim(fmt::format("{}: least step that is answered", c.full), *least, "N"), c.threshold,
                        "median of the nerve, from memory, unverified");
        if (auto ok = options.at(static_cast<double>(&c - classes + 1) / 5); !ok) return ok.error();
    }
    out.finds(fmt::format("type I has the larger contrast of onset and hold: SA-I {:.2g}, SA-II {:.2g}", contrasts[0], contrasts[1]),
              contrasts[0] > contrasts[1], words);
    out.plot("The step", "time (s)", "force (N)").add("force", touch->line());
    out.plots.push_back(
        spikes.shape("slowly adapting classes fire as long as the skin is pressed, fast adapting ones at its onset and removal"));
    out.note(
        "The thesis sorts type I from type II by the contrast of sustained and onset discharge; the literature that it cites does so by "
        "receptive field, small and sharp against large and diffuse (errata B18), which one afferent by itself cannot show.");
    out.note(
        "Four classes, 17,000 units in the glabrous hand: read in the abstract of Vallbo and Johansson. That they are 43 % FA-I, 25 % "
        "SA-I, "
        "13 % FA-II and 19 % SA-II is from memory, unverified.");
    out.note("The models are made for forces of 0.2 to 4 N and have a leak of a share of that: they need far more than the nerve does.");
    out.note(
        "Values of sa2 and fa2 are a choice, the thesis has none; without noise, all classes fire evenly. What SA-II makes of the step's "
        "end is the |F'| of SA-IA, which the thesis calls more suitable to SA-II (3.1). A step rises within one sample, 0.1 ms.");
    return out;
}

const Study study{
    "fig3", "The four classes of the skin under a step",
    "Slowly adapting classes fire as long as the skin is pressed, fast adapting ones only at onset and removal; type I with a large "
    "contrast between the two, type II with a small one. Thesis 1.2, fig. 3",
    work};

}  // namespace corpuscle::studies::fig3
