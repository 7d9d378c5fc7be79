#pragma once
// What answers live: a skin by name or file, or afferents by name on so many channels; and how its spikes are addressed.

#include "io/events.hpp"
#include "signal/settings.hpp"
#include "skin/innervation.hpp"

namespace corpuscle {

/// Whether all that is listed are afferents that have a name, or are made of parts.
bool is_afferents(std::string_view list);

/// Afferents by name ("sa1,fa1"), each on every one of `channels`. Wishes that name one of them are marked as used.
Result<SkinPlan> plan_channels(std::string_view afferents, std::size_t channels, std::span<const Wish> wishes = {});
Result<SkinPlan> plan_channels(std::string_view afferents, std::span<const Channel> channels, std::span<const Wish> wishes = {});

/// "hand", "grid 8x8", a population file; or afferents by name on channels. Wishes that name one of its classes are marked as used.
Result<SkinPlan> plan_live(std::string_view population, std::size_t channels, std::span<const Wish> wishes = {});

/// The names of a unit, its channel or region, and its address: on a grid, and wherever each class has one unit at each site,
/// taxel * classes + class, else the unit's number.
EventUnits event_units(const Innervation&, const Clock&);

}  // namespace corpuscle
