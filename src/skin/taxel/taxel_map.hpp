#pragma once
// The map from the forces of taxels to the forces at the sites of a skin. It is linear, and the same for recordings and live frames.

#include "skin/plan/sites.hpp"
#include "skin/taxel/taxel_layout.hpp"

namespace corpuscle {

/// The force at sites[k] is the sum of weight[e] * force of taxel[e], for e from begin[k] to begin[k + 1]. Other sites have no force.
struct TaxelMap {
    std::size_t taxel_count = 0;
    std::vector<std::uint32_t> sites;  ///< ascending
    std::vector<std::uint32_t> begin;  ///< one more element than sites
    std::vector<std::uint32_t> taxel;
    std::vector<double> weight;
    std::vector<double> total;       ///< for each taxel, the sum of its weights: 1, 0 if it is dead, above 1 if it also replaces neighbours
    std::vector<std::string> notes;  ///< for the user

    /// Overwrites the force (N) at sites[k] by that of the taxels: element sites[k] * stride of `force` for each k. `taxels` has one force
    /// for each taxel.
    void spread(const double* taxels, double* force, std::size_t stride = 1) const;
};

/// Spreads each taxel's force over the cells of the sites in its area, in proportion to the overlap. A taxel that is partly off the skin
/// puts its complete force on the part that is on it, which `notes` report. One that is completely off the skin is an error. A point acts
/// on the site in whose cell it is. A dead taxel that is interpolated has the mean force of the nearest taxels of its patch that are
/// measured, up to four, weighted by 1 / distance.
Result<TaxelMap> map_taxels(const TaxelLayout&, const Sites&);

}  // namespace corpuscle
