#include "reproduction/texture/chip_comparison.hpp"

#include <fmt/format.h>

#include "reproduction/texture/accuracy_plot.hpp"

namespace corpuscle {
namespace {

const std::vector<TextureReader> readers = {{"SA-I chips", {"sa1-circuit"}},
                                            {"SA-I models", {"sa1"}},
                                            {"FA-I chips", {"fa1-circuit"}},
                                            {"FA-I models", {"fa1"}},
                                            {"SA-I and FA-I chips", {"sa1-circuit", "fa1-circuit"}},
                                            {"SA-I and FA-I models", {"sa1", "fa1"}}};

/// Every second taxel.
std::vector<TaxelValues> with_fewer_taxels(const std::vector<TaxelValues>& all) {
    std::vector<TaxelValues> out;
    for (const auto& recording : all) {
        auto& kept = out.emplace_back();
        for (std::size_t c = 0; c < texture_taxels; c += texture_taxels / chip_taxels)
            kept.frames.push_back(recording.frames[c]), kept.smooth.push_back(recording.smooth[c]);
    }
    return out;
}

/// A task with the features of chips and models.
Result<TextureTask> make_chip_task(const TextureSurfaces& surfaces, SlidePart part, const std::function<bool(double)>& progress) {
    std::vector<Slide> slow;
    std::vector<TaxelValues> forces;
    const auto all = slide_forces(surfaces.slides, part, texture_scale);
    for (std::size_t k = 0; k < all.size(); ++k)
        if (surfaces.slides[k].speed == 0) slow.push_back(surfaces.slides[k]), forces.push_back(all[k]);
    forces = with_fewer_taxels(forces);
    TextureTask out(slide_trials(slow, texture_window, chip_duration));
    double done = 0;
    for (const std::string model : {"sa1", "fa1"}) {
        const auto chip = model + "-circuit";
        const auto part_progress = [&](double fraction) { return progress((done + fraction) / 2); };
        out.add(chip, spike_counts(out.trials(), TRY(simulate_slides_with_chips(chip, forces, chip_duration, part_progress))));
        out.add(model, spike_counts(out.trials(), TRY(simulate_slides(model, forces)))), done += 1;
    }
    return out;
}

}  // namespace

Result<void> compare_texture_chips(StudyResult& out, const TextureSurfaces& surfaces, SlidePart part, const char* part_name,
                                   const std::function<bool(double)>& progress) {
    const auto task = TRY(make_chip_task(surfaces, part, progress));
    const auto accuracy = [&](const std::vector<std::string>& features) {
        return task.accuracy(features, SlideTest::other_half, chip_taxels);
    };
    const auto label =
        fmt::format("{} {}, other half, {} taxels, {:g} s", surfaces.name, part_name, chip_taxels, chip_duration - slide_start);
    for (const auto& r : readers) {
        const auto a = accuracy(r.features);
        out.claim(fmt::format("{}, {}: accuracy", label, r.name), 100 * a.mean, "%").explain(interval_text(a));
    }
    for (const auto& [kind, model] : {std::pair{"SA-I", std::string("sa1")}, {"FA-I", std::string("fa1")}}) {
        const auto rate = [&](const std::string& name) { return task.mean(name) / texture_window; };
        out.claim(fmt::format("{}, {}: mean firing rate of the chips", label, kind), rate(model + "-circuit"), "Hz");
        out.claim(fmt::format("{}, {}: mean firing rate of the models", label, kind), rate(model), "Hz");
        out.claim(fmt::format("{}, {}: chips less models, difference of the accuracies", label, kind),
                  100 * (accuracy({model + "-circuit"}).mean - accuracy({model}).mean), "%")
            .allow_range(-20, 20, "check: chips tell as much as models")
            .explain_if_needed("the chips respond to weaker stimuli than their models, as the firing rates show");
    }
    plot_over_taxels(out, label, task, SlideTest::other_half, readers, chip_taxels, surfaces.chance);
    return {};
}

}  // namespace corpuscle
