#include "run/skin/skin_scene.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "skin/plan/skin_plan.hpp"
#include "skin/taxel/taxel_map.hpp"
#include "skin/taxel/taxel_texture.hpp"

namespace corpuscle {
namespace {

constexpr std::string_view default_indenter = "flat";

/// Directs a recording of taxels at the skin.
Result<void> add_taxels(SkinScene& scene, const SkinSceneRequest& request, ForceSource& source) {
    if (!request.contact.empty())
        return bad_usage("--contact presses one force on the skin, and --taxels spreads those of taxels; use one");
    if (request.has_layout) return bad_usage("--layout and --taxels both say where the channels are; use --taxels only");
    const auto layout = TRY(read_taxel_layout(request.taxels));
    TRY(check_shear(layout, source));
    std::vector<std::string> names;
    for (const auto& c : source.channels()) names.push_back(c.name);
    const auto taxels = TRY(match_taxels(layout, names, source.name()));
    const auto& sites = scene.innervation->plan.sites;
    auto map = TRY(map_taxels(layout, sites));
    scene.notes.insert(scene.notes.end(), map.notes.begin(), map.notes.end());
    auto texture = TRY(make_taxel_texture(request.overrides, sites, source.clock().rate(), scene.innervation->plan.seed));
    keep_unused(scene.unused, texture.unused);
    if (texture.result)
        for (auto& note : texture.result->notes()) scene.notes.push_back(std::move(note));
    scene.force = make_taxel_force(source, layout, std::move(map), taxels, sites.size(), std::move(texture.result));
    return {};
}

/// Directs one channel at each site.
Result<void> add_site_force(SkinScene& scene, const std::string& indenter, ForceSource& source) {
    const auto channels = source.channels().size();
    if (!indenter.empty())
        return bad_usage(channels > 1 ? fmt::format("--contact {}: {} has {} channels; an indenter needs a force of one channel", indenter,
                                                    source.name(), channels)
                                      : fmt::format("--contact {}: the skin has one site; an indenter needs several", indenter));
    auto at = TRY(match_sites(scene.innervation->plan, source));
    scene.force = make_site_force(source, std::move(at), scene.innervation->plan.sites.size());
    return {};
}

/// Directs the force at the sites: with an indenter if it has one channel and the skin several sites.
Result<void> add_force(SkinScene& scene, const SkinSceneRequest& request, ForceSource& source) {
    if (!request.taxels.empty()) return add_taxels(scene, request, source);
    const auto& plan = scene.innervation->plan;
    if (source.channels().size() > 1 || plan.sites.size() == 1) return add_site_force(scene, request.contact, source);
    const auto indenter = !request.contact.empty() ? std::string_view(request.contact)
                          : request.touch          ? request.touch->indenter
                                                   : default_indenter;
    auto contact = TRY(make_contact(indenter, request.overrides, plan.sites, source.clock(), plan.seed));
    keep_unused(scene.unused, contact.unused);
    scene.contact = std::move(contact.result);
    scene.force = make_pressed_force(source, *scene.contact);
    return {};
}

}  // namespace

Result<SkinScene> SkinScene::make(const SkinSceneRequest& request, ForceSource& source) {
    auto plan = TRY(load_skin_plan(request.population, source.channels()));
    auto applied = TRY(apply_overrides(std::move(plan), request.overrides));
    SkinScene scene;
    scene.unused = std::move(applied.unused);
    if (request.seed != 0) applied.result.seed = request.seed;
    if (source.channels().size() == 1 || !request.taxels.empty())
        if (auto note = treat_as_skin(applied.result); !note.empty()) scene.notes.push_back(std::move(note));
    scene.innervation = TRY(innervate(std::move(applied.result)));
    TRY(add_force(scene, request, source));
    return scene;
}

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

}  // namespace corpuscle
