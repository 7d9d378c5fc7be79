#include "skin/contact/skin_cells.hpp"

#include "core/number/number.hpp"

namespace corpuscle {
namespace {

constexpr double isolated_side = 2e-3;  // m, for a site without a neighbour; choice

/// The typical distance between sites, m: the median over sites of the distance to the nearest site at another position.
double typical_distance(const Sites& sites, const SiteGrid& grid) {
    std::vector<double> distances;
    for (std::uint32_t s = 0; s < sites.size(); ++s) {
        double best = 0;  // squared distance; 0: none found yet
        for (double reach = grid.cell_side(); best == 0 && reach < 100; reach *= 2)
            grid.for_each_within(sites.positions[s].x, sites.positions[s].y, reach, [&](std::uint32_t, double d2) {
                if (d2 > 0 && (best == 0 || d2 < best)) best = d2;
            });
        if (best > 0) distances.push_back(num::sqrt(best));
    }
    if (distances.empty()) return isolated_side;
    const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
    std::nth_element(distances.begin(), middle, distances.end());
    return *middle;
}

}  // namespace

SkinCells::SkinCells(const Sites& sites) : sites_(sites), index_(std::make_unique<SiteGrid>(sites.positions)) {
    side_ = sites.area > 0 ? num::sqrt(sites.area) : typical_distance(sites, *index_);
    if (!build_lattice()) lattice_.clear();
}

bool SkinCells::build_lattice() {
    constexpr double max_cells = 1 << 24;
    constexpr double tolerance = 1e-3;  // largest distance of a site from the centre of its cell, as a fraction of side_
    double left = sites_.positions[0].x, low = sites_.positions[0].y, right = left, high = low;
    for (const auto& p : sites_.positions)
        left = std::min(left, p.x), low = std::min(low, p.y), right = std::max(right, p.x), high = std::max(high, p.y);
    const double columns = std::round((right - left) / side_) + 1, rows = std::round((high - low) / side_) + 1;
    if (!(columns * rows <= max_cells)) return false;
    columns_ = static_cast<std::size_t>(columns), rows_ = static_cast<std::size_t>(rows);
    left_ = left - 0.5 * side_, low_ = low - 0.5 * side_;
    lattice_.assign(columns_ * rows_, no_site);
    for (std::uint32_t s = 0; s < sites_.size(); ++s) {
        const double c = (sites_.positions[s].x - left) / side_, r = (sites_.positions[s].y - low) / side_;
        if (std::abs(c - std::round(c)) > tolerance || std::abs(r - std::round(r)) > tolerance) return false;
        auto& cell = lattice_[static_cast<std::size_t>(std::round(c)) * rows_ + static_cast<std::size_t>(std::round(r))];
        if (cell != no_site) return false;
        cell = s;
    }
    return true;
}

}  // namespace corpuscle
