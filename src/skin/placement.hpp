#pragma once
// Places the afferents of a skin and computes their receptive fields: the two steps of innervate().

#include "skin/innervation.hpp"
#include "skin/site_grid.hpp"

namespace corpuscle {

/// The afferents of one class, region by region. In each region they are placed along a Hilbert curve, which keeps neighbours close
/// together in the list. The afferents of a class with `per_site` are placed on the sites, in their order.
Result<std::vector<SkinAfferent>> place_afferents(const SkinPlan&, std::uint32_t class_index);

/// Element [from * regions + to] is 1 if a receptive field in region `from` may extend into region `to`, which must touch it. If sites are
/// sensors, all elements are 1.
std::vector<char> touching_regions(const Sites&, const SiteGrid&);

/// The receptive fields of the afferents of one class.
Result<ReceptiveFields> receptive_fields_of(const SkinPlan&, std::uint32_t class_index, std::span<const SkinAfferent>, const SiteGrid&,
                                            const std::vector<char>& touching);

/// The number of the random stream of a class for one quantity, such as "velocity".
std::uint32_t class_stream(const SkinClass&, std::string_view quantity);

inline constexpr std::size_t max_afferents = std::size_t{1} << 24, max_weights = 200'000'000;

}  // namespace corpuscle
