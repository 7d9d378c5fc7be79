#pragma once
// The outline of a skin, for drawings: smooth curves through the edges of its shapes, not the steps of its sites.

#include "skin/plan/sites.hpp"

namespace corpuscle {

using Polygon = std::vector<Position>;  ///< closed; m

struct SkinOutline {
    std::vector<Polygon> skin;                  ///< around all regions together, counter-clockwise; holes are clockwise
    std::vector<std::vector<Polygon>> regions;  ///< around each region, in the order of Sites::regions
};

/// The outline of a skin whose sites fill regions. Empty for all other sites, which have no shapes. A point that is in several regions
/// belongs to the first of them. Corners are rounded: of the skin by about one pitch, of the regions by about half of it. A round end whose
/// radius is five pitches becomes about a tenth of the pitch smaller.
SkinOutline skin_outline(const Sites&);

}  // namespace corpuscle
