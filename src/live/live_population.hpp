#pragma once
// The population of a live stream: a skin by name or file, or named afferents on a number of channels. Also the names and addresses of its
// afferents in the output.

#include "io/spikes/events.hpp"
#include "skin/innervation.hpp"

namespace corpuscle {

/// True if every item of a comma-separated list is a named afferent, or a combination of components.
bool is_afferent_list(std::string_view list);

/// A plan of named afferents ("sa1,fa1"), each on every one of `channels` channels, which are named "ch1", "ch2" ... or have names of their
/// own. Overrides whose target is one of the afferents are applied.
Result<Applied<SkinPlan>> make_channel_plan(std::string_view afferents, std::size_t channels,
                                            std::span<const ParameterOverride> overrides = {});
Result<Applied<SkinPlan>> make_channel_plan(std::string_view afferents, std::span<const Channel> channels,
                                            std::span<const ParameterOverride> overrides = {});

/// The plan of a population: "hand", "grid 8x8", a population file, or named afferents on `channels` channels, which is ignored otherwise.
/// Overrides whose target is one of its classes are applied.
Result<Applied<SkinPlan>> make_live_plan(std::string_view population, std::size_t channels,
                                         std::span<const ParameterOverride> overrides = {});

/// The names, the channel or region, and the address of each afferent. If each class has one afferent at each site, as on a grid, the
/// address is (site * number of classes) + class, where site and class are counted from 0. Otherwise it is the index of the afferent.
EventAddressing make_event_addressing(const Innervation&, const Clock&);

}  // namespace corpuscle
