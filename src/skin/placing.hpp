#pragma once
// Where the afferents of a skin stand, and what each of them feels: the two halves of innervate().

#include "skin/innervation.hpp"
#include "skin/near.hpp"

namespace corpuscle {

/// The units of one class, region by region, in each along a curve that keeps neighbours together; a class of so many units a site
/// stands on its sites, in their order.
Result<std::vector<SkinUnit>> placed_units(const SkinPlan&, std::uint32_t of);

/// Which regions a field may spread to from each: those that touch it, by [from * regions + to]. Where sites are sensors, all.
std::vector<char> touching_regions(const Sites&, const NearSites&);

/// What the units of one class feel.
Result<ReceptiveFields> fields_of(const SkinPlan&, std::uint32_t of, std::span<const SkinUnit>, const NearSites&,
                                  const std::vector<char>& touching);

/// The stream of random numbers that one class draws one thing from.
std::uint32_t class_stream(const SkinClass&, std::string_view what);

inline constexpr std::size_t most_units = std::size_t{1} << 24, most_weights = 200'000'000;

}  // namespace corpuscle
