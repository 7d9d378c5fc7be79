#pragma once
// A spatial index of sites: the plane is divided into square cells, and each cell lists the sites inside it. Unrelated to sites that form a
// grid.

#include <algorithm>
#include <limits>

#include "skin/plan/sites.hpp"

namespace corpuscle {

class SiteGrid {
public:
    explicit SiteGrid(const std::vector<Position>& positions);  ///< of the sites; at least one

    /// Calls f(site, d2) for each site within `reach` (m) of (x, y), where d2 is its squared distance (m2). The order of the
    /// calls depends only on the positions of the sites.
    template <class F>
    void for_each_within(double x, double y, double reach, F&& f) const {
        const double max_d2 = reach * reach;
        const auto left = column(x - reach), right = column(x + reach), low = row(y - reach), high = row(y + reach);
        for (auto r = low; r <= high; ++r)
            for (auto k = begin_[r * columns_ + left]; k < begin_[r * columns_ + right + 1]; ++k) {  // the cells of a row are consecutive
                const auto& s = sorted_[k];
                const double dx = s.x - x, dy = s.y - y, d2 = dx * dx + dy * dy;
                if (d2 <= max_d2) f(s.site, d2);
            }
    }

    /// The site nearest to (x, y); if several are equally near, the one with the lowest number.
    std::uint32_t nearest(double x, double y) const;
    double cell_side() const { return cell_side_; }  ///< side of a cell, m

private:
    struct IndexedSite {
        double x, y;
        std::uint32_t site;
    };
    double left_ = 0, low_ = 0, cell_side_ = 1;  // m; left_, low_: lower left corner of the first cell
    std::size_t columns_ = 1, rows_ = 1;
    std::vector<std::uint32_t> begin_;  // for each cell, row by row: index of its first site in sorted_; then the number of sites
    std::vector<IndexedSite> sorted_;   // the sites, cell by cell

    /// The number of the column (or row) at this distance, in cells, from the first edge; limited to [0, count - 1].
    static std::size_t clamped(double cells, std::size_t count) {
        return cells > 0 ? std::min(static_cast<std::size_t>(std::min(cells, 1e9)), count - 1) : 0;
    }
    std::size_t column(double x) const { return clamped((x - left_) / cell_side_, columns_); }
    std::size_t row(double y) const { return clamped((y - low_) / cell_side_, rows_); }
};

}  // namespace corpuscle
