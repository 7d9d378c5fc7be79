#include "reproduction/skin/skin_touch.hpp"

#include <algorithm>

#include "core/stimulus/stimuli.hpp"
#include "run/skin/skin_force.hpp"

namespace corpuscle {

Result<std::shared_ptr<const Innervation>> skin_without_conduction(std::string_view name) {
    auto plan = TRY(load_skin_plan(name));
    plan.nerve.reset();
    return innervate(std::move(plan));
}

Result<std::vector<SpikeTimes>> simulate_touch(const std::shared_ptr<const Innervation>& innervation, const SkinTouch& touch) {
    const auto overrides = TRY(parse_overrides(touch.settings));
    const auto source = TRY(make_stimulus(touch.stimulus, overrides, touch.rate, 0));
    const auto clock = source.result->clock();
    const auto contact = TRY(make_contact(touch.indenter, overrides, innervation->plan.sites, clock));
    const auto set = TRY(instruction_set());
    const auto skin = TRY(Skin::make(innervation, {.dt = clock.T()}, set));
    const auto force = make_pressed_force(*source.result, *contact.result);
    ThreadPool one_thread(1);
    std::vector<Spike> spikes;
    for (;;) {
        const auto block = TRY(force->next());
        if (block.total_force.empty()) break;
        TRY(skin->respond(block.force, block.total_force.size(), spikes, one_thread));
    }
    skin->finish(spikes);
    std::vector<SpikeTimes> out(innervation->afferents.size());
    for (const auto& s : spikes) out[s.afferent_index].push_back(clock.time(s.step, s.offset));
    return out;
}

std::size_t spikes_between(const SpikeTimes& train, double from, double to) {
    return static_cast<std::size_t>(std::count_if(train.begin(), train.end(), [=](double t) { return t >= from && t < to; }));
}

}  // namespace corpuscle
