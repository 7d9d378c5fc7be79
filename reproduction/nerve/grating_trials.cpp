#include "reproduction/nerve/grating_trials.hpp"

#include <fmt/format.h>
#include <cmath>

#include "core/random.hpp"

namespace corpuscle {
namespace {

constexpr Position patch_place{0, 12e-3};  // m, the middle of the fingertip

GratingTrial draw_trial(std::uint32_t number, bool slides, std::uint64_t seed) {
    constexpr auto purpose = static_cast<std::uint32_t>(stream_id("grating trial"));
    const auto uniform = [&](std::uint32_t quantity) {
        const auto w = philox({quantity, 0, number, purpose}, seed);
        return unit_interval(w[0], w[1]);
    };
    GratingTrial out{.period = number % grating_periods.size()};
    out.force = 0.5 * std::pow(4.0, uniform(0));
    out.place = {3e-3 * (uniform(1) - 0.5), 3e-3 * (uniform(2) - 0.5)};
    if (!slides) return out;
    out.speed = 20e-3 * std::pow(4.0, uniform(3));
    out.start = uniform(4) * grating_periods[out.period] / out.speed;  // the grating slides from 0 s on
    return out;
}

SkinTouch touch_of(const GratingTrial& t) {
    const double period = grating_periods[t.period];
    SkinTouch out{"ramp-hold",
                  "grating",
                  {fmt::format("ramp-hold.F_max={}", t.force), fmt::format("ramp-hold.t_rest={}", t.start),
                   fmt::format("ramp-hold.t_up={}", grating_ramp),
                   fmt::format("ramp-hold.t_hold={}", grating_settled - grating_ramp + grating_counted), "ramp-hold.t_down=0",
                   "ramp-hold.t_post=0", fmt::format("contact.radius={}", grating_patch), fmt::format("contact.period={}", period),
                   fmt::format("contact.ridge={}", period / 2), fmt::format("contact.x={}", patch_place.x + t.place.x),
                   fmt::format("contact.y={}", patch_place.y + t.place.y)}};
    if (t.speed > 0) out.settings.push_back(fmt::format("contact.speed={}", t.speed));
    return out;
}

}  // namespace

Result<std::vector<GratingTrial>> simulate_gratings(const std::shared_ptr<const Innervation>& skin, std::size_t trials, bool slides,
                                                    std::uint64_t seed) {
    std::vector<GratingTrial> out;
    for (std::size_t k = 0; k < trials; ++k) {
        out.push_back(draw_trial(static_cast<std::uint32_t>(k), slides, seed));
        out.back().spikes = TRY(simulate_touch(skin, touch_of(out.back())));
    }
    return out;
}

std::vector<ReadoutTrial> spike_counts(const Innervation& skin, const std::vector<GratingTrial>& trials, std::string_view class_name,
                                       double duration, bool knows_speed) {
    constexpr double middle_speed = 40e-3;  // m/s
    std::vector<ReadoutTrial> out;
    for (const auto& t : trials) {
        ReadoutTrial trial{{}, t.period};
        const double from = t.start + grating_settled, octaves = knows_speed ? std::log2(t.speed / middle_speed) : 0;
        for (std::size_t u = 0; u < t.spikes.size(); ++u) {
            if (!class_name.empty() && skin.plan.classes[skin.afferents[u].class_index].name != class_name) continue;
            const auto count = static_cast<double>(spikes_between(t.spikes[u], from, from + duration));
            trial.features.push_back(count);
            if (knows_speed) trial.features.push_back(count * octaves);
        }
        out.push_back(std::move(trial));
    }
    return out;
}

}  // namespace corpuscle
