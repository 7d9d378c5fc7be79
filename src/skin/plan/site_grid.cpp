#include "skin/plan/site_grid.hpp"

#include <numeric>

#include "core/number/number.hpp"

namespace corpuscle {

SiteGrid::SiteGrid(const std::vector<Position>& positions) {
    constexpr double sites_per_cell = 0.7;  // for evenly distributed sites; the fastest value measured
    double right = positions[0].x, high = positions[0].y;
    left_ = right, low_ = high;
    for (const auto& p : positions)
        left_ = std::min(left_, p.x), right = std::max(right, p.x), low_ = std::min(low_, p.y), high = std::max(high, p.y);
    const double width = right - left_, height = high - low_, n = static_cast<double>(positions.size());
    cell_side_ = std::max({num::sqrt(width * height * sites_per_cell / n), std::max(width, height) * sites_per_cell / n, 1e-9});
    columns_ = static_cast<std::size_t>(width / cell_side_) + 1, rows_ = static_cast<std::size_t>(height / cell_side_) + 1;
    const auto cell_of = [this](const Position& p) { return row(p.y) * columns_ + column(p.x); };
    begin_.assign(columns_ * rows_ + 1, 0);
    for (const auto& p : positions) ++begin_[cell_of(p) + 1];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    auto next = begin_;
    sorted_.resize(positions.size());
    for (std::uint32_t s = 0; s < positions.size(); ++s) sorted_[next[cell_of(positions[s])]++] = {positions[s].x, positions[s].y, s};
}

std::uint32_t SiteGrid::nearest(double x, double y) const {
    double best = std::numeric_limits<double>::infinity();
    std::uint32_t found = 0;
    const auto visit = [&](std::uint32_t site, double d2) {
        if (d2 < best || (d2 == best && site < found)) best = d2, found = site;
    };
    const double right = left_ + cell_side_ * static_cast<double>(columns_), high = low_ + cell_side_ * static_cast<double>(rows_);
    // `outside`: how far (x, y) is outside of the cells. The search radius beyond it is doubled until a site is found.
    const double outside = std::max({left_ - x, x - right, low_ - y, y - high, 0.0});
    for (double reach = outside + cell_side_; best == std::numeric_limits<double>::infinity(); reach = outside + (reach - outside) * 2)
        for_each_within(x, y, reach, visit);
    return found;
}

}  // namespace corpuscle
