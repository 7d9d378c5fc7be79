#pragma once
// Places the afferents of a skin and computes their receptive fields: the two halves of innervate().

#include "skin/innervation.hpp"
#include "skin/site_grid.hpp"

namespace corpuscle {

/// The afferents of one class, region by region, in each along a curve that keeps neighbours together. A class with a number for each site
/// is placed on its sites, in their order.
Result<std::vector<SkinAfferent>> place_afferents(const SkinPlan&, std::uint32_t class_index);

/// The regions that a field may extend to from each region: those that touch it, at [from * regions + to]. If sites are sensors, all
/// regions.
std::vector<char> touching_regions(const Sites&, const SiteGrid&);

/// The receptive fields of the afferents of one class.
Result<ReceptiveFields> receptive_fields_of(const SkinPlan&, std::uint32_t class_index, std::span<const SkinAfferent>, const SiteGrid&,
                                            const std::vector<char>& touching);

/// The random stream of a class for one quantity.
std::uint32_t class_stream(const SkinClass&, std::string_view what);

inline constexpr std::size_t max_afferents = std::size_t{1} << 24, max_weights = 200'000'000;

}  // namespace corpuscle
