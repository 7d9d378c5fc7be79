#include "corpuscle/respond.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "api/result.hpp"
#include "api/view_source.hpp"
#include "core/stimulus/stimuli.hpp"
#include "core/thread_pool.hpp"
#include "run/afferent_plan.hpp"
#include "run/channels/channel_warnings.hpp"
#include "run/skin/skin_scene.hpp"
#include "run/skin/skin_simulator.hpp"
#include "run/summary/run_summary.hpp"
#include "run/summary/skin_summary.hpp"
#include "skin/plan/skin_plan.hpp"

namespace corpuscle {
namespace {

using api::value_or_throw;

constexpr double default_channel_rate = 10e3, default_skin_rate = 1e3;  // Hz, of stimuli

/// Collects the spikes of a run.
class SpikeCollector final : public Sink {
    Response& to_;

    void add(const Input& input, std::span<const Spike> spikes) {
        for (const auto& s : spikes) {
            to_.times.push_back(input.clock.time(s.step, s.offset));
            to_.indices.push_back(static_cast<std::uint32_t>(input.afferent_of(s)));
        }
    }

public:
    explicit SpikeCollector(Response& to) : to_(to) {}
    Result<void> begin(const Input& input) override {
        const auto& all = input.population;
        for (std::size_t u = 0; u < all.size(); ++u) {
            const auto at = all.position(u);
            constexpr double none = std::numeric_limits<double>::quiet_NaN();
            to_.afferents.push_back({all.afferent_name(u), base_name(all.class_plan(all.class_of(u))), all.channel_name(u),
                                     at ? at->x : none, at ? at->y : none});
        }
        to_.start = input.clock.t0;
        return {};
    }
    Result<void> block(const Input& input, const RunBlock& block) override { return add(input, block.spikes), Result<void>(); }
    Result<void> end(const Input& input, std::int64_t samples, std::span<const Spike> last) override {
        to_.duration = input.since_start(samples);
        return add(input, last), Result<void>();
    }
};

void append(std::vector<std::string>& to, std::vector<std::string> more) { std::move(more.begin(), more.end(), std::back_inserter(to)); }

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

/// The options of a completed run, for its summary.
RespondOptions without_run(RespondOptions options) {
    options.pool = nullptr, options.should_continue = {};
    return options;
}

/// The settings of a simulation, and those that nothing has used so far.
struct Settings {
    std::vector<ParameterOverride> all, unused;
    explicit Settings(const Simulation& simulation) : all(value_or_throw(parse_overrides(simulation.settings))), unused(all) {}
};

/// The planned afferents of a run on channels: one of each requested afferent, or all copies.
struct ChannelPlans {
    std::vector<AfferentPlan> afferents = {}, copies = {};
    CopySpec spec = {};
};

ChannelPlans plan_channels(const Simulation& simulation, Settings& settings) {
    ChannelPlans out;
    out.spec.count = simulation.copies;
    for (const auto& name : simulation.afferents) {
        auto planned = value_or_throw(plan_any_afferent(name, settings.all));
        keep_unused(settings.unused, planned.unused);
        out.afferents.push_back(std::move(planned.result));
    }
    auto spreads = value_or_throw(parse_overrides(simulation.spreads));
    if (simulation.copies == 0) {
        if (!spreads.empty()) throw InputError("spreads need copies");
        return out.copies = out.afferents, out;
    }
    std::vector<std::string_view> names;
    for (const auto& afferent : out.afferents) {
        names.push_back(afferent.name);
        auto applied = value_or_throw(distributions_for(afferent, spreads));
        spreads = std::move(applied.unused);
        auto copies = value_or_throw(make_copies(afferent, simulation.copies, applied.result, simulation.seed));
        std::move(copies.begin(), copies.end(), std::back_inserter(out.copies));
        std::move(applied.result.begin(), applied.result.end(), std::back_inserter(out.spec.distributions));
    }
    value_or_throw(check_all_used(spreads, names));
    return out;
}

/// The number of threads of a run. `samples`: of the force, over all channels; 0 if unknown. A short run of equations takes less time than
/// the start of a thread.
unsigned threads_for(const Simulation& simulation, std::span<const AfferentPlan> plans, std::size_t samples) {
    constexpr std::size_t short_run = 20'000;  // afferents times samples: some 0.2 ms
    const bool is_short = samples > 0 && samples < short_run && plans.size() * samples < short_run &&
                          std::all_of(plans.begin(), plans.end(), [](const AfferentPlan& p) { return p.traits().can_use_lanes; });
    return is_short ? 1 : simulation.threads;
}

Response respond_on_channels(std::unique_ptr<ForceSource> source, const Simulation& simulation, Settings& settings,
                             std::size_t samples = 0) {
    auto plans = plan_channels(simulation, settings);
    std::vector<std::string_view> names = {source->name()};
    for (const auto& a : plans.afferents) names.push_back(a.name);
    value_or_throw(check_all_used(settings.unused, names));
    Response out;
    ThreadPool pool(threads_for(simulation, plans.copies, samples));
    const auto options = options_of(simulation, pool);
    std::vector<std::unique_ptr<ForceSource>> sources;
    sources.push_back(std::move(source));
    out.warnings = rate_warnings(sources, plans.afferents);
    append(out.warnings, noise_warnings(plans.afferents, options.noise));
    const auto summary = std::make_shared<RunSummary>();
    SpikeCollector spikes(out);
    Sink* const sinks[] = {summary.get(), &spikes};
    auto stats = value_or_throw(run(sources, plans.copies, sinks, options));
    if (!stats.diverged.empty()) api::throw_error(stats.diverged[0]);
    out.notes = sources[0]->notes();
    for (const auto& i : summary->inputs) append(out.notes, i.quality.descriptions), append(out.warnings, i.quality.warnings);
    append(out.warnings, response_warnings(stats));
    out.summary = [summary, afferents = std::move(plans.afferents), stats = std::move(stats), options = without_run(options),
                   warnings = out.warnings] { return summary->document(afferents, stats, options, warnings).dump(); };
    return out;
}

/// Adds metadata, notes and warnings about force and contact. Call it after the run.
void add_scene_notes(SkinRunNotes& notes, const ForceSource& source, const SkinScene& scene) {
    auto quality = source.quality();
    notes.metadata = source.metadata();
    for (auto& some : {source.notes(), quality.descriptions, scene.force->notes(), scene.notes}) append(notes.notes, some);
    append(notes.warnings, std::move(quality.warnings));
    if (!scene.contact) return;
    notes.contact = scene.contact->description();
    for (auto& entry : scene.contact->metadata()) notes.metadata.push_back(std::move(entry));
    append(notes.notes, scene.contact->notes());
}

Response respond_of_skin(std::unique_ptr<ForceSource> source, const std::string& name, const NamedTouch* touch,
                         const Simulation& simulation, Settings& settings) {
    auto scene = value_or_throw(SkinScene::make({.population = simulation.population,
                                                 .contact = simulation.contact,
                                                 .taxels = simulation.taxels,
                                                 .touch = touch,
                                                 .overrides = settings.all,
                                                 .seed = simulation.seed},
                                                *source));
    keep_unused(settings.unused, scene.unused);
    value_or_throw(check_all_used(settings.unused, override_targets(scene.innervation->plan, {"contact", source->name()})));
    Response out;
    ThreadPool pool(simulation.threads);
    const auto options = options_of(simulation, pool);
    SkinPopulation population(*scene.innervation, name);
    const auto skin = value_or_throw(Skin::make(scene.innervation, options.for_clock(source->clock()), value_or_throw(instruction_set())));
    std::vector<std::unique_ptr<BlockSimulator>> inputs;
    inputs.push_back(std::make_unique<SkinSimulator>(population, make_input(population, name, *source), *scene.force, *skin));
    const auto summary = std::make_shared<SkinSummary>();
    SpikeCollector spikes(out);
    Sink* const sinks[] = {summary.get(), &spikes};
    SkinRunNotes notes;
    notes.stats = value_or_throw(run(std::move(inputs), sinks, options));
    add_scene_notes(notes, *source, scene);
    out.notes = notes.notes, out.warnings = notes.warnings;
    // SkinSummary refers to the innervation.
    out.summary = [summary, skin = scene.innervation, options = without_run(options), notes = std::move(notes)] {
        return summary->document(options, notes).dump();
    };
    return out;
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
    Settings settings(simulation);
    auto source = api::make_view_source(force);
    return simulation.population.empty() ? respond_on_channels(std::move(source), simulation, settings, force.count * force.samples.size())
                                         : respond_of_skin(std::move(source), force.name, nullptr, simulation, settings);
}

Response respond(const std::string& afferent, const ForceView& force, const std::vector<std::string>& settings) {
    return respond(force, {.afferents = {afferent}, .settings = settings});
}

Response respond_to(const std::string& name, const Simulation& simulation, double rate) {
    Settings settings(simulation);
    const auto all = named_touches();
    const auto touch = std::find_if(all.begin(), all.end(), [&](const NamedTouch& t) { return t.name == name; });
    const bool is_touch = touch != all.end() && !simulation.population.empty();
    if (is_touch) add_touch_overrides(settings.all, *touch);
    if (rate == 0) rate = simulation.population.empty() ? default_channel_rate : default_skin_rate;
    auto source = value_or_throw(make_stimulus(is_touch ? std::string(touch->force) : name, settings.all, rate, simulation.seed));
    keep_unused(settings.unused, source.unused);
    return simulation.population.empty()
               ? respond_on_channels(std::move(source.result), simulation, settings)
               : respond_of_skin(std::move(source.result), name, is_touch ? &*touch : nullptr, simulation, settings);
}

}  // namespace corpuscle
