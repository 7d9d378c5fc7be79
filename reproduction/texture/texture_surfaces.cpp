#include "reproduction/texture/texture_surfaces.hpp"

#include <fmt/format.h>

namespace corpuscle {
namespace {

Result<void> read_all(TextureSurfaces& surfaces, const std::string& folder, std::optional<double> lowpass = {}) {
    for (auto& s : surfaces.slides) TRY(read_slide(s, folder, lowpass));
    for (const auto part : {SlidePart::all, SlidePart::change, SlidePart::change_shape}) {
        auto task = TRY(make_texture_task(surfaces.slides, slide_forces(surfaces.slides, part, texture_scale)));
        surfaces.tasks.emplace(part, std::move(task));
    }
    return {};
}

const std::vector<Slide> gratings = {{"Board2mm_F150_V-5mmps_0", 0}, {"Board10mm_F150_V-5mmps_0", 1}};

}  // namespace

Result<TextureSurfaces> read_fabrics(const std::string& folder) {
    TextureSurfaces out{"fabrics", 1.0 / 3};
    std::size_t surface = 0;
    for (const char* fabric : {"BeigeCotton", "Canvas", "Linen"}) {
        for (const std::size_t grip : {0U, 1U})
            for (const std::size_t speed : {0U, 1U})
                out.slides.push_back({fmt::format("{}_F{}_V{}mmps_0", fabric, grip ? 210 : 120, speed ? 100 : 20), surface, grip, speed});
        ++surface;
    }
    TRY(read_all(out, folder));
    return out;
}

Result<TextureSurfaces> read_gratings(const std::string& folder) {
    TextureSurfaces out{"gratings", 1.0 / 2, gratings};
    TRY(read_all(out, folder));
    return out;
}

Result<TextureSurfaces> read_slow_gratings(const std::string& folder) {
    TextureSurfaces out{"gratings below 3 Hz", 1.0 / 2, gratings};
    TRY(read_all(out, folder, texture_lowpass));
    return out;
}

Result<TextureTask> make_texture_task(const std::vector<Slide>& slides, const std::vector<TaxelValues>& forces, double window) {
    TextureTask out(slide_trials(slides, window));
    out.add("mean", mean_readings(out.trials(), forces)), out.add("change", mean_changes(out.trials(), forces));
    for (const char* afferent : {"sa1", "fa1", "sa1-nerve", "fa1-nerve"})
        out.add(afferent, spike_counts(out.trials(), TRY(simulate_slides(afferent, forces))));
    return out;
}

}  // namespace corpuscle
