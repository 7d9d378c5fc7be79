#include "reproduction/skin/fingertip.hpp"

#include <fmt/format.h>

#include "core/stimulus/stimuli.hpp"
#include "run/skin/skin_force.hpp"

namespace corpuscle {
namespace {

constexpr double fingertip_rate = 1e3;          // Hz
constexpr Position fingertip_centre{0, 12e-3};  // m: x, y of the middle of the built-in fingertip

Result<std::vector<FingertipTrain>> press_fingertip(const Innervation& tip, const Position& centre, Skin& skin, SkinForce& force,
                                                    const Clock& clock) {
    std::vector<FingertipTrain> out;
    for (const auto& u : tip.afferents) {
        const double dx = u.position.x - centre.x, dy = u.position.y - centre.y;
        out.push_back({tip.plan.classes[u.class_index].name, num::sqrt(dx * dx + dy * dy), {}, u.direction});
    }
    ThreadPool pool(1);
    std::vector<Spike> spikes;
    for (;;) {
        const auto block = TRY(force.next());
        if (block.total_force.empty()) break;
        TRY(skin.respond(block.force, block.total_force.size(), spikes, pool));
    }
    skin.finish(spikes);
    for (const auto& s : spikes) out[s.afferent_index].spikes.push_back(clock.time(s.step, s.offset));
    return out;
}

}  // namespace

Result<std::vector<FingertipTrain>> simulate_fingertip(const Punch& punch) {
    auto plan = TRY(load_skin_plan("fingertip"));
    plan.nerve.reset();  // no conduction delay
    const auto tip = TRY(innervate(std::move(plan)));
    const Position centre{fingertip_centre.x + punch.shift.x, fingertip_centre.y + punch.shift.y};
    std::vector<std::string> settings = {fmt::format("press.F_min={}", punch.rest_force), fmt::format("press.F_max={}", punch.force),
                                         fmt::format("contact.radius={}", punch.radius), fmt::format("contact.x={}", centre.x),
                                         fmt::format("contact.y={}", centre.y)};
    if (punch.tilt > 0)
        settings.push_back(fmt::format("contact.tilt={}", punch.tilt)),
            settings.push_back(fmt::format("contact.azimuth={}", punch.azimuth));
    const auto overrides = TRY(parse_overrides(settings));
    auto source = TRY(make_stimulus("press", overrides, fingertip_rate, 0));
    auto contact = TRY(make_contact("flat", overrides, tip->plan.sites, source.result->clock()));
    const auto set = TRY(instruction_set());
    auto skin = TRY(Skin::make(tip, {.dt = 1 / fingertip_rate}, set));
    const auto force = make_pressed_force(*source.result, *contact.result);
    return press_fingertip(*tip, centre, *skin, *force, source.result->clock());
}

}  // namespace corpuscle
