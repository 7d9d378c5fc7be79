#include "live/live_population.hpp"

#include <fmt/format.h>

#include "model/catalog.hpp"
#include "skin/class_settings.hpp"
#include "skin/sites.hpp"

namespace corpuscle {
namespace {

std::vector<std::string> names_in(std::string_view list) {
    std::vector<std::string> names;
    for (std::size_t at = 0; at <= list.size();) {
        const auto end = std::min(list.find(',', at), list.size());
        names.emplace_back(list.substr(at, end - at));
        at = end + 1;
    }
    return names;
}

Result<SkinClass> class_at_each_site(const std::string& name, std::span<const ParameterOverride> overrides) {
    const auto plan = plan_afferent(name, overrides);
    if (!plan) return plan.error();
    SkinClass each{.name = plan->name, .afferent = *plan};
    each.per_site = 1;
    return each;
}

}  // namespace

bool is_afferents(std::string_view list) {
    for (const auto& name : names_in(list))
        if (!plan_afferent(name, {})) return false;
    return true;
}

Result<SkinPlan> plan_channels(std::string_view afferents, std::size_t channels, std::span<const ParameterOverride> overrides) {
    auto sites = grid_sites(1, channels, 1e-3);
    if (!sites) return sites.error();
    SkinPlan plan;
    plan.name = afferents, plan.is_by_channel = true;
    plan.sentence = fmt::format("{} on {} channel{}", afferents, channels, channels == 1 ? "" : "s");
    plan.sites = std::move(*sites);
    for (std::size_t c = 0; c < channels; ++c) plan.sites.names[c] = fmt::format("ch{}", c + 1);
    for (const auto& name : names_in(afferents)) {
        auto each = class_at_each_site(name, overrides);
        if (!each) return each.error();
        for (const auto& other : plan.classes)
            if (other.name == each->name) return bad_usage(fmt::format("'{}' is given twice", name));
        plan.classes.push_back(std::move(*each));
    }
    return plan;
}

Result<SkinPlan> plan_channels(std::string_view afferents, std::span<const Channel> channels, std::span<const ParameterOverride> overrides) {
    auto plan = plan_channels(afferents, channels.size(), overrides);
    if (plan)
        for (std::size_t c = 0; c < channels.size(); ++c) plan->sites.names[c] = channels[c].name;
    return plan;
}

Result<SkinPlan> plan_live(std::string_view population, std::size_t channels, std::span<const ParameterOverride> overrides) {
    if (is_afferents(population)) return plan_channels(population, channels, overrides);
    auto plan = plan_skin(population);
    if (!plan) return plan;
    if (auto ok = set_classes(*plan, overrides); !ok) return ok.error();
    return plan;
}

EventAddressing event_units(const Innervation& skin, const Clock& clock) {
    EventAddressing out{clock, {}, {}, {}, {}};
    bool one_each = true;
    for (const auto& c : skin.plan.classes) one_each &= c.density.empty() && c.per_site == 1;
    const auto classes = static_cast<std::uint32_t>(skin.plan.classes.size());
    const auto& sites = skin.plan.sites;
    for (std::size_t u = 0; u < skin.units.size(); ++u) {
        const auto& afferent = skin.units[u];
        out.names.push_back(skin.unit_name(u));
        out.addresses.push_back(one_each ? (afferent.copy - 1) * classes + afferent.of : static_cast<std::uint32_t>(u));
        out.afferents.push_back(skin.plan.is_by_channel ? skin.plan.classes[afferent.of].name : out.names.back());
        out.channels.push_back(skin.plan.is_by_channel ? sites.names[afferent.copy - 1] : sites.regions[afferent.region]);
    }
    return out;
}

}  // namespace corpuscle
