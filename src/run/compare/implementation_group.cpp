#include "run/compare/implementation_group.hpp"

#include <algorithm>
#include <filesystem>

#include "core/text/ascii_text.hpp"

namespace corpuscle {
namespace {

/// The catalogue's afferent with this name or alias; null if there is none.
const NamedAfferent* find_afferent(const std::string& name) {
    for (const auto& a : named_afferents())
        if (a.name == name || std::find(a.aliases.begin(), a.aliases.end(), name) != a.aliases.end()) return &a;
    return nullptr;
}

/// The afferent with the lowest rank is the reference: 0 the afferent that has the name of the type, 1 another model, 2 an implementation.
int reference_rank(const AfferentPlan& plan, const std::string& afferent_type) {
    return plan.traits().is_implementation ? 2 : plan.name == afferent_type ? 0 : 1;
}

}  // namespace

std::string afferent_type_of(const AfferentPlan& plan) {
    const auto stem = std::filesystem::path(plan.name).stem().string();  // without folder and extension, if the name is a path
    const auto name = lower(stem);
    // A type has a name without hyphen: the alias SA-I leads to sa1 here, but sa1-kim is reduced to its prefix below.
    if (const auto* a = find_afferent(name); a && a->name.find('-') == a->name.npos) return std::string(a->name);
    const auto* prefix_match = find_afferent(name.substr(0, name.find_first_of("-_")));
    return prefix_match ? std::string(prefix_match->name) : stem;
}

std::vector<ImplementationGroup> implementation_groups(std::span<const AfferentPlan> plans) {
    std::vector<ImplementationGroup> all;
    for (std::size_t k = 0; k < plans.size(); ++k) {
        const auto afferent_type = afferent_type_of(plans[k]);
        auto at =
            std::find_if(all.begin(), all.end(), [&](const ImplementationGroup& group) { return group.afferent_type == afferent_type; });
        if (at == all.end()) at = all.insert(at, {afferent_type, {}});
        at->members.push_back(k);
    }
    for (auto& group : all)
        std::sort(group.members.begin(), group.members.end(), [&](std::size_t a, std::size_t b) {
            return std::pair(reference_rank(plans[a], group.afferent_type), a) <
                   std::pair(reference_rank(plans[b], group.afferent_type), b);
        });
    return all;
}

}  // namespace corpuscle
