#include "corpuscle/respond.hpp"

#include <algorithm>
#include <limits>

#include "api/force_origin.hpp"
#include "api/response_parts.hpp"
#include "api/view_source.hpp"
#include "core/stimulus/stimuli.hpp"
#include "core/thread_pool.hpp"
#include "model/copies.hpp"
#include "run/skin/skin_scene.hpp"
#include "skin/contact/indenters.hpp"

namespace corpuscle {
namespace api {

RespondOptions options_of(const Simulation& simulation, ThreadPool& pool) {
    RespondOptions out{.method = simulation.backward_euler ? Method::backward_euler : Method::exact,
                       .sampled = simulation.sampled,
                       .noise = simulation.noise,
                       .seed = simulation.seed,
                       .precision = simulation.single_precision ? Precision::single_precision : Precision::double_precision,
                       .pool = &pool};
    if (simulation.progress) out.should_continue = simulation.progress;
    return out;
}

void SpikeCollector::add(const Input& input, std::span<const Spike> spikes) {
    for (const auto& s : spikes) {
        to_.times.push_back(input.clock.time(s.step, s.offset));
        to_.indices.push_back(static_cast<std::uint32_t>(input.afferent_of(s)));
    }
}

Result<void> SpikeCollector::begin(const Input& input) {
    const auto& all = input.population;
    for (std::size_t u = 0; u < all.size(); ++u) {
        const auto at = all.position(u);
        constexpr double none = std::numeric_limits<double>::quiet_NaN();
        to_.afferents.push_back(
            {all.afferent_name(u), base_name(all.class_plan(all.class_of(u))), all.channel_name(u), at ? at->x : none, at ? at->y : none});
    }
    to_.start = input.clock.t0;
    return {};
}

Result<void> SpikeCollector::end(const Input& input, std::int64_t samples, std::span<const Spike> last) {
    to_.duration = input.since_start(samples);
    return add(input, last), Result<void>();
}

}  // namespace api

namespace {

constexpr double default_channel_rate = 10e3, default_skin_rate = 1e3;  // Hz, of stimuli

Response respond_to_input(api::ForceInput input, const Simulation& simulation, api::Settings& settings) {
    return simulation.population.empty() ? api::respond_on_channels(std::move(input), simulation, settings)
                                         : api::respond_of_skin(std::move(input), simulation, settings);
}

}  // namespace

std::vector<double> Response::train(std::size_t afferent) const {
    if (afferent >= afferents.size()) throw InputError("there is no afferent " + std::to_string(afferent));
    std::vector<double> out;
    for (std::size_t k = 0; k < times.size(); ++k)
        if (indices[k] == afferent) out.push_back(times[k]);
    return out;
}

Response respond(const ForceView& force, const Simulation& simulation) {
    api::Settings settings(simulation);
    return respond_to_input({.source = api::make_view_source(force),
                             .name = force.name,
                             .has_unit = force.origin && force.origin->has_unit,
                             .samples = force.count * force.samples.size()},
                            simulation, settings);
}

Response respond(const std::string& afferent, const ForceView& force, const std::vector<std::string>& settings) {
    return respond(force, {.afferents = {afferent}, .settings = settings});
}

Response respond_to(const std::string& name, const Simulation& simulation, double rate) {
    api::Settings settings(simulation);
    const auto all = named_touches();
    const auto touch = std::find_if(all.begin(), all.end(), [&](const NamedTouch& t) { return t.name == name; });
    const bool is_touch = touch != all.end() && !simulation.population.empty();
    if (is_touch) add_touch_overrides(settings.all, *touch);
    if (rate == 0) rate = simulation.population.empty() ? default_channel_rate : default_skin_rate;
    auto source = api::value_or_throw(make_stimulus(is_touch ? std::string(touch->force) : name, settings.all, rate, simulation.seed));
    keep_unused(settings.unused, source.unused);
    return respond_to_input({.source = std::move(source.result), .name = name, .touch = is_touch ? &*touch : nullptr, .is_named = true},
                            simulation, settings);
}

}  // namespace corpuscle
