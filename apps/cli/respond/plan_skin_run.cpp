// Plans the run of a skin: reads the options, opens the force, places the afferents and makes the contact.

#include <fmt/format.h>
#include <algorithm>

#include "cli/respond/skin_run.hpp"
#include "core/text/ascii_text.hpp"
#include "skin/plan/class_overrides.hpp"
#include "skin/plan/indented_array.hpp"

namespace corpuscle {
namespace {

constexpr double skin_rate = 1e3;  // Hz, default sample rate of stimuli
constexpr std::string_view default_indenter = "flat";

/// Adds the settings of a touch as overrides. Overrides of the user take precedence.
void add_touch_overrides(std::vector<ParameterOverride>& overrides, const NamedTouch& touch) {
    const auto add = [&](std::string_view target, const std::vector<Setting>& settings) {
        for (const auto& s : settings)
            if (std::none_of(overrides.begin(), overrides.end(),
                             [&](const ParameterOverride& entry) { return entry.target == target && entry.parameter == s.name; }))
                overrides.push_back({std::string(target), std::string(s.name), fmt::format("{}", s.value)});
    };
    add("contact", touch.settings);
    add(touch.force, touch.force_settings);
}

/// Makes job.force: with an indenter if the force has one channel and the skin several sites, otherwise from one channel for each site.
Result<void> open_contact(SkinJob& job, std::string indenter, const NamedTouch* touch) {
    const auto& sites = job.skin->plan.sites;
    const std::size_t channels = job.source->channels().size();
    if (channels > 1 || sites.size() == 1) {
        if (!indenter.empty())
            return bad_usage(channels > 1 ? fmt::format("--contact {}: {} has {} channels; an indenter needs a force of one channel",
                                                        indenter, job.source->name(), channels)
                                          : fmt::format("--contact {}: the skin has one site; an indenter needs several", indenter));
        auto at = TRY(match_sites(job.skin->plan, *job.source));
        job.force = make_site_force(*job.source, std::move(at), sites.size());
        return {};
    }
    if (indenter.empty()) indenter = touch ? touch->indenter : default_indenter;
    auto contact = TRY(make_contact(indenter, job.overrides, sites, job.source->clock()));
    keep_unused(job.unused, contact.unused);
    job.contact = std::move(contact.result);
    job.force = make_pressed_force(*job.source, *job.contact);
    return {};
}

/// Loads the population, applies the overrides to its classes, and places its afferents.
Result<void> place_afferents(SkinJob& job, const std::string& population) {
    auto plan = TRY(load_skin_plan(population, job.source->channels()));
    auto applied = TRY(apply_overrides(std::move(plan), job.overrides));
    keep_unused(job.unused, applied.unused);
    auto& skin_plan = applied.result;
    if (job.options.seed != 0) skin_plan.seed = job.options.seed;  // 0, the default, keeps the seed of the population file
    if (job.source->channels().size() == 1) job.skin_note = treat_as_skin(skin_plan);
    job.skin = TRY(innervate(std::move(skin_plan)));
    return {};
}

}  // namespace

Result<SkinJob> plan_skin_job(const RespondArguments& args, bool quiet) {
    if (args.forces.size() != 1) return bad_usage(fmt::format("--population takes one FORCE, not {}", args.forces.size()));
    SkinJob job;
    job.options = args.simulation;
    job.overrides = job.unused = args.settings;
    const auto* touch = args.forces[0].touch;
    if (touch) add_touch_overrides(job.overrides, *touch);
    const auto force = touch ? ForceArgument{std::string(touch->force), true} : args.forces[0];
    job.source = TRY(open_source(job, force, args.recording, skin_rate, quiet));
    job.name = touch ? std::string(touch->name) : job.source->name();
    TRY(place_afferents(job, args.population));
    TRY(open_contact(job, args.contact, touch));
    const auto targets = override_targets(job.skin->plan, {"contact", job.source->name()});
    TRY(check_all_used(job.unused, targets));
    return job;
}

}  // namespace corpuscle
