// Arbitrary bytes as a population file. Expected: a skin whose receptive-field weights are consistent, or an error with a message and a
// location.

#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "skin/innervation.hpp"

using namespace corpuscle;

namespace {

void must(bool ok) {
    if (!ok) std::abort();
}

/// A wave either has all its values or is that of a class without one.
void check_wave(const WaveParams& wave) {
    if (wave.speed == 0) return must(wave == WaveParams{});
    must(wave.speed > 0 && wave.decay > 0 && wave.radius > 0 && wave.gain >= 0 && wave.corner > 0);
}

void check(const Innervation& skin) {
    for (const auto& c : skin.plan.classes) check_wave(c.wave);
    must(skin.afferents.size() == skin.class_begin.back() && skin.fields.size() == skin.plan.classes.size());
    for (const auto& u : skin.afferents)
        must(std::isfinite(u.position.x) && std::isfinite(u.position.y) && std::isfinite(u.delay) && u.delay >= 0);
    for (std::size_t c = 0; c < skin.fields.size(); ++c) {
        const auto& f = skin.fields[c];
        const auto afferent_count = skin.class_begin[c + 1] - skin.class_begin[c];
        must(f.begin.size() == skin.plan.sites.size() + 1 && f.afferent.size() == f.begin.back());
        const auto& plan = skin.plan.classes[c];
        must(f.receptors == plan.receptors());
        std::vector<double> sums(afferent_count * f.receptors);
        for (std::size_t k = 0; k < f.afferent.size(); ++k) {
            must(f.afferent[k] < sums.size() && (f.weight[k] >= 0 || plan.surround > 0));
            sums[f.afferent[k]] += f.weight[k];
        }
        const double expected_sum = skin.plan.felt_area > 0 ? skin.plan.felt_area / skin.plan.sites.area : 1;
        // Without a site in reach, a receptor feels the nearest site and no surround.
        for (const double s : sums) must(std::abs(s / expected_sum - (1 - plan.surround)) < 1e-9 || std::abs(s / expected_sum - 1) < 1e-9);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const Channel channels[] = {{0, "p1", Position{0, 0, 0}}, {1, "p2", Position{2e-3, 0, 0}}};
    const auto plan = parse_skin_plan({reinterpret_cast<const char*>(data), size}, "fuzz.toml", channels);
    if (!plan) {
        must(!plan.error().message.empty() && !plan.error().location.file.empty());
        return 0;
    }
    must(!plan->sites.positions.empty() && !plan->classes.empty());
    double work = 0;
    for (std::uint32_t c = 0; c < plan->classes.size(); ++c)
        for (const auto n : afferents_by_region(*plan, c))
            work += static_cast<double>(n) * plan->classes[c].hot_spots * (plan->classes[c].depth > 0 ? 100 : 1) *
                    static_cast<double>(plan->sites.size());
    if (work > 1e7) return 0;  // a large skin tests nothing more than a small one, but is slow
    const auto skin = innervate(*plan);
    skin ? check(**skin) : must(!skin.error().message.empty());
    return 0;
}
