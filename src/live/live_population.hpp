#pragma once
// The population of a live stream: a skin by name or file, or named afferents on a number of channels. Also the addresses of its spikes.

#include "io/events.hpp"
#include "signal/parameter_override.hpp"
#include "skin/innervation.hpp"

namespace corpuscle {

/// True if every item of the list is a named afferent, or a combination of components.
bool is_afferent_list(std::string_view list);

/// Named afferents ("sa1,fa1"), each on every one of `channels`. Overrides that name one of them are marked as used.
Result<SkinPlan> make_channel_plan(std::string_view afferents, std::size_t channels, std::span<const ParameterOverride> overrides = {});
Result<SkinPlan> make_channel_plan(std::string_view afferents, std::span<const Channel> channels,
                                   std::span<const ParameterOverride> overrides = {});

/// "hand", "grid 8x8", a population file, or named afferents on channels. Overrides that name one of its classes are marked as used.
Result<SkinPlan> make_live_plan(std::string_view population, std::size_t channels, std::span<const ParameterOverride> overrides = {});

/// For each afferent its names, its channel or region, and its address. If each class has one afferent at each site, as on a grid, the
/// address is site * classes + class. Otherwise it is the index of the afferent.
EventAddressing make_event_addressing(const Innervation&, const Clock&);

}  // namespace corpuscle
