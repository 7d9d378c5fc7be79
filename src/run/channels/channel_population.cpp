#include "run/channels/channel_population.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "core/text/csv_field.hpp"
#include "model/copies.hpp"

namespace corpuscle {

ChannelPopulation::ChannelPopulation(const ForceSource& source, std::span<const AfferentPlan> plans, const std::string& input_name,
                                     bool is_only_input)
    : plans_(plans), sensors_(source.channels()) {
    for (const auto& sensor : sensors_)
        names_.push_back(is_only_input ? sensor.name : sensor.name == source.name() ? input_name : input_name + ":" + sensor.name);
    const auto groups = copy_group_starts(plans);
    for (std::size_t g = 0; g + 1 < groups.size(); ++g) class_of_.resize(groups[g + 1], g);
}

std::size_t ChannelPopulation::class_count() const { return class_of_.empty() ? 0 : class_of_.back() + 1; }

const AfferentPlan& ChannelPopulation::class_plan(std::size_t c) const {
    const auto first = std::lower_bound(class_of_.begin(), class_of_.end(), c);
    return plans_[static_cast<std::size_t>(first - class_of_.begin())];
}

BinGroups ChannelPopulation::bin_groups() const {
    BinGroups out{"afferent,channel", {}, {}};
    for (std::size_t u = 0; u < size(); ++u) {
        out.groups.push_back({quote_csv_field(plan_of(u).name) + "," + quote_csv_field(names_[channel_of(u)])});
        out.group_of.push_back(static_cast<std::uint32_t>(u));
    }
    return out;
}

/// An afferent has the number of its channel, as on a grid of sites, and its index is its address.
Result<PlanTable> ChannelPopulation::plan_table() const {
    PlanTable out{{plans_.begin(), plans_.end()}, {}};
    for (std::size_t u = 0; u < size(); ++u) out.plan_of.push_back(static_cast<std::uint32_t>(u % plans_.size()));
    return out;
}

EventAddressing ChannelPopulation::event_addressing(const Clock& clock) const {
    EventAddressing out{clock, {}, {}, {}, {}};
    for (std::size_t u = 0; u < size(); ++u) {
        out.names.push_back(fmt::format("{}#{}", plan_of(u).name, channel_of(u) + 1));
        out.addresses.push_back(static_cast<std::uint32_t>(u));
        out.afferents.push_back(plan_of(u).name);
        out.channels.push_back(names_[channel_of(u)]);
    }
    return out;
}

}  // namespace corpuscle
