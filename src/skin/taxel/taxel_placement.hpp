#pragma once
// The places of taxels on a skin: their centres, and the cells of skin that their areas overlap.

#include "skin/plan/sites.hpp"
#include "skin/taxel/taxel_layout.hpp"

namespace corpuscle {

double distance_between(const Position&, const Position&);  ///< in the plane of the skin, m

struct PlacedTaxel {
    Position centre;                                         ///< m, on the skin
    std::vector<std::pair<std::uint32_t, double>> overlaps;  ///< sites in ascending order, and the overlap with the cell of each, m2
    double fraction_on_skin = 1;                             ///< of the taxel's area
};

/// Places all taxels. A region that the skin does not have, and a taxel that is completely off the skin, are errors.
Result<std::vector<PlacedTaxel>> place_taxels(const TaxelLayout&, const Sites&);

}  // namespace corpuscle
