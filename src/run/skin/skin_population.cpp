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

EventAddressing SkinPopulation::event_addressing(const Clock& clock) const { return make_event_addressing(skin_, clock); }

}  // namespace corpuscle
