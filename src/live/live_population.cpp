#include "live/live_population.hpp"

#include <fmt/format.h>

#include "core/text/ascii_text.hpp"

namespace corpuscle {
namespace {

/// A class with one afferent of this name at each site.
Result<Applied<SkinClass>> class_at_each_site(std::string_view name, std::span<const ParameterOverride> overrides) {
    auto planned = TRY(plan_afferent(name, overrides));
    SkinClass added{.name = planned.result.name, .afferent = planned.result};
    added.per_site = 1;
    return Applied<SkinClass>{std::move(added), std::move(planned.unused)};
}

}  // namespace

bool is_afferent_list(std::string_view list) {
    for (const auto name : split(list, ','))
        if (!plan_afferent(name)) return false;
    return true;
}

Result<Applied<SkinPlan>> make_channel_plan(std::string_view afferents, std::size_t channels,
                                            std::span<const ParameterOverride> overrides) {
    SkinPlan plan;
    plan.sites = TRY(grid_sites(1, channels, 1e-3));  // a site for each channel; the distance of 1 mm is arbitrary
    plan.name = afferents, plan.is_by_channel = true;
    plan.description = fmt::format("{} on {} channel{}", afferents, channels, channels == 1 ? "" : "s");
    for (std::size_t c = 0; c < channels; ++c) plan.sites.names[c] = fmt::format("ch{}", c + 1);
    std::vector<ParameterOverride> unused(overrides.begin(), overrides.end());
    for (const auto name : split(afferents, ',')) {
        auto added = TRY(class_at_each_site(name, overrides));
        for (const auto& other : plan.classes)
            if (other.name == added.result.name) return bad_usage(fmt::format("'{}' is given twice", name));
        plan.classes.push_back(std::move(added.result));
        keep_unused(unused, added.unused);
    }
    return Applied<SkinPlan>{std::move(plan), std::move(unused)};
}

Result<Applied<SkinPlan>> make_channel_plan(std::string_view afferents, std::span<const Channel> channels,
                                            std::span<const ParameterOverride> overrides) {
    auto plan = make_channel_plan(afferents, channels.size(), overrides);
    if (plan)
        for (std::size_t c = 0; c < channels.size(); ++c) plan->result.sites.names[c] = channels[c].name;
    return plan;
}

Result<Applied<SkinPlan>> make_live_plan(std::string_view population, std::size_t channels, std::span<const ParameterOverride> overrides) {
    if (is_afferent_list(population)) return make_channel_plan(population, channels, overrides);
    auto plan = TRY(load_skin_plan(population));
    return apply_overrides(std::move(plan), overrides);
}

EventAddressing make_event_addressing(const Innervation& skin, const Clock& clock) {
    EventAddressing out{clock, {}, {}, {}, {}};
    bool one_per_site = true;  // true: afferent.number - 1 is also the index of its site
    for (const auto& c : skin.plan.classes) one_per_site &= c.density.empty() && c.per_site == 1;
    const auto classes = static_cast<std::uint32_t>(skin.plan.classes.size());
    const auto& sites = skin.plan.sites;
    for (std::size_t u = 0; u < skin.afferents.size(); ++u) {
        const auto& afferent = skin.afferents[u];
        out.names.push_back(skin.afferent_name(u));
        out.addresses.push_back(one_per_site ? (afferent.number - 1) * classes + afferent.class_index : static_cast<std::uint32_t>(u));
        out.afferents.push_back(skin.plan.is_by_channel ? skin.plan.classes[afferent.class_index].name : out.names.back());
        // A plan by channel has one afferent of each class at each site, so number - 1 is the site.
        out.channels.push_back(skin.plan.is_by_channel ? sites.names[afferent.number - 1] : sites.regions[afferent.region]);
    }
    return out;
}

}  // namespace corpuscle
