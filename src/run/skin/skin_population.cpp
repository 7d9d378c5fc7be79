#include "run/skin/skin_population.hpp"

#include <fmt/format.h>
#include <map>

#include "core/text/csv_field.hpp"
#include "live/live_population.hpp"

namespace corpuscle {

/// One group for each class in each region that has afferents of it.
BinGroups SkinPopulation::bin_groups() const {
    using ClassAndRegion = std::pair<std::uint32_t, std::uint32_t>;
    std::map<ClassAndRegion, std::uint32_t> counts, group_at;
    for (const auto& u : skin_.afferents) ++counts[{u.class_index, u.region}];
    BinGroups out{"afferent,channel,afferents", {}, {}};
    for (const auto& [at, count] : counts) {
        group_at[at] = static_cast<std::uint32_t>(out.groups.size());
        out.groups.push_back({fmt::format("{},{},{}", quote_csv_field(skin_.plan.classes[at.first].name),
                                          quote_csv_field(skin_.plan.sites.regions[at.second]), count),
                              1.0 * count});
    }
    for (const auto& u : skin_.afferents) out.group_of.push_back(group_at[{u.class_index, u.region}]);
    return out;
}

/// The plans of a class whose parameters vary are sampled as in the simulation.
Result<PlanTable> SkinPopulation::plan_table() const {
    PlanTable out;
    for (std::size_t c = 0; c < skin_.plan.classes.size(); ++c) {
        const auto& plan = skin_.plan.classes[c];
        const auto count = skin_.class_begin[c + 1] - skin_.class_begin[c];
        const bool varies = !plan.distributions.empty();
        const auto first = static_cast<std::uint32_t>(out.plans.size());
        for (std::uint32_t k = 0; k < count; ++k) out.plan_of.push_back(varies ? first + k : first);
        if (!varies) out.plans.push_back(plan.afferent);
        if (varies)
            for (auto& p : TRY(make_copies(plan.afferent, static_cast<std::uint32_t>(count), plan.distributions, skin_.plan.seed)))
                out.plans.push_back(std::move(p));
    }
    return out;
}

EventAddressing SkinPopulation::event_addressing(const Clock& clock) const { return make_event_addressing(skin_, clock); }

}  // namespace corpuscle
