#pragma once
// Places the afferents of a skin and computes their receptive fields: the two steps of innervate().

#include "skin/innervation.hpp"
#include "skin/plan/site_grid.hpp"

namespace corpuscle {

/// The afferents of one class, with their positions and delays. If the class has a density, they are listed region by region, and in each
/// region along a Hilbert curve through its sites, so that neighbours on the skin are close together in the list. If the class has
/// `per_site`, they are at the sites, in the order of the sites.
Result<std::vector<SkinAfferent>> place_afferents(const SkinPlan&, std::uint32_t class_index);

/// Element [from * regions + to] is 1 if a receptive field in region `from` may extend into region `to`: if the two regions touch, or
/// are the same. If the sites are separate sensors, all elements are 1.
std::vector<char> touching_regions(const Sites&, const SiteGrid&);

/// The receptive fields of the afferents of one class. `touching` is the result of touching_regions().
Result<ReceptiveFields> receptive_fields_of(const SkinPlan&, std::uint32_t class_index, std::span<const SkinAfferent>, const SiteGrid&,
                                            const std::vector<char>& touching);

/// Identifies the random numbers for one quantity of a class, such as "velocity".
std::uint32_t class_stream(const SkinClass&, std::string_view quantity);

/// Limits of a skin: afferents of all classes; sites in the receptive fields of one class, summed over afferents.
inline constexpr std::size_t max_afferents = std::size_t{1} << 24, max_weights = 200'000'000;

}  // namespace corpuscle
