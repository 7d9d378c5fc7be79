// Plans the run of a skin: reads the options, opens the force, places the afferents and makes the contact.

#include <fmt/format.h>
#include <algorithm>

#include "cli/respond/skin_run.hpp"
#include "core/text/ascii_text.hpp"
#include "skin/plan/skin_plan.hpp"

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

}  // namespace

/// Makes force_: with an indenter if the force has one channel and the skin several sites, otherwise from one channel for each site.
Result<void> SkinRun::open_contact(std::string indenter, const NamedTouch* touch) {
    const auto& sites = innervation_->plan.sites;
    const std::size_t channels = source_->channels().size();
    if (channels > 1 || sites.size() == 1) {
        if (!indenter.empty())
            return bad_usage(channels > 1 ? fmt::format("--contact {}: {} has {} channels; an indenter needs a force of one channel",
                                                        indenter, source_->name(), channels)
                                          : fmt::format("--contact {}: the skin has one site; an indenter needs several", indenter));
        auto at = TRY(match_sites(innervation_->plan, *source_));
        force_ = make_site_force(*source_, std::move(at), sites.size());
        return {};
    }
    if (indenter.empty()) indenter = touch ? touch->indenter : default_indenter;
    auto contact = TRY(make_contact(indenter, overrides_, sites, source_->clock()));
    keep_unused(unused_, contact.unused);
    contact_ = std::move(contact.result);
    force_ = make_pressed_force(*source_, *contact_);
    return {};
}

/// Loads the population, applies the overrides to its classes, and places its afferents.
Result<void> SkinRun::place_afferents() {
    auto plan = TRY(load_skin_plan(args_.population, source_->channels()));
    auto applied = TRY(apply_overrides(std::move(plan), overrides_));
    keep_unused(unused_, applied.unused);
    auto& skin_plan = applied.result;
    if (options_.seed != 0) skin_plan.seed = options_.seed;  // 0, the default, keeps the seed of the population file
    if (source_->channels().size() == 1) skin_note_ = treat_as_skin(skin_plan);
    innervation_ = TRY(innervate(std::move(skin_plan)));
    return {};
}

Result<void> SkinRun::plan() {
    if (args_.forces.size() != 1) return bad_usage(fmt::format("--population takes one FORCE, not {}", args_.forces.size()));
    overrides_ = unused_ = args_.settings;
    const auto* touch = args_.forces[0].touch;
    if (touch) add_touch_overrides(overrides_, *touch);
    source_ = TRY(open_source(touch ? ForceArgument{std::string(touch->force), true} : args_.forces[0], skin_rate));
    name_ = touch ? std::string(touch->name) : source_->name();
    TRY(place_afferents());
    population_.emplace(*innervation_, name_);
    TRY(open_contact(args_.contact, touch));
    return check_all_used(unused_, override_targets(innervation_->plan, {"contact", source_->name()}));
}

}  // namespace corpuscle
