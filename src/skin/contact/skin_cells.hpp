#pragma once
// The cells of a skin: the square of skin that each site represents. Finds the cells around a contact.

#include <cmath>

#include "skin/plan/site_grid.hpp"

namespace corpuscle {

/// If the sites are on a square lattice, each site is the centre of a lattice cell, and cells without a site are not skin. Otherwise each
/// site is the centre of a square of its own, and these squares may overlap. Their side is the root of the sites' area or, without one, the
/// typical distance between sites.
class SkinCells {
public:
    explicit SkinCells(const Sites&);

    double side() const { return side_; }  ///< of a cell, m
    bool is_lattice() const { return !lattice_.empty(); }

    /// Visits the columns of cells that may overlap the box around (x, y) with this half width and half height (m). Calls f(x0, edges,
    /// sites) for each column: the x of its left edge, the y of the edges of its cells from below, and the site of each cell, or no_site.
    /// Without a lattice, each cell is a column by itself.
    template <class F>
    void for_each_column(double x, double y, double half_width, double half_height, F&& f);

    static constexpr std::uint32_t no_site = UINT32_MAX;

private:
    double side_, left_ = 0, low_ = 0;  // m; left_, low_: the lattice's lower left corner
    std::size_t columns_ = 0, rows_ = 0;
    std::vector<std::uint32_t> lattice_;  // site of each cell [column][row], or no_site; empty: not a lattice
    const Sites& sites_;
    std::unique_ptr<SiteGrid> index_;
    std::vector<double> edges_;                        // scratch arrays of for_each_column()
    std::vector<std::uint32_t> column_sites_, found_;  // the same

    bool build_lattice();  ///< false: the sites are not on a lattice
};

template <class F>
void SkinCells::for_each_column(double x, double y, double half_width, double half_height, F&& f) {
    if (!is_lattice()) {
        found_.clear();
        const double reach = (half_width > half_height ? half_width : half_height) * 1.4142135623730951 + side_;
        index_->for_each_within(x, y, reach, [&](std::uint32_t site, double) { found_.push_back(site); });
        std::sort(found_.begin(), found_.end());
        edges_.resize(2);
        for (const auto site : found_) {
            const auto& at = sites_.positions[site];
            edges_[0] = at.y - 0.5 * side_, edges_[1] = at.y + 0.5 * side_;
            f(at.x - 0.5 * side_, std::span<const double>(edges_), std::span<const std::uint32_t>(&site, 1));
        }
        return;
    }
    constexpr double max_cells = 1e6;  // limit of a contact's distance from the skin and of its width, in cells
    // Number of the cell that contains coordinate `at`, if cell 0 begins at `from`.
    const auto cell = [&](double at, double from) {
        return static_cast<std::int64_t>(std::max(-max_cells, std::min(max_cells, std::floor((at - from) / side_))));
    };
    const auto low = cell(y - half_height, low_), high = cell(y + half_height, low_);
    const auto count = static_cast<std::size_t>(high - low + 1);
    edges_.resize(count + 1), column_sites_.resize(count);
    for (std::size_t k = 0; k <= count; ++k) edges_[k] = low_ + static_cast<double>(low + static_cast<std::int64_t>(k)) * side_;
    for (auto c = cell(x - half_width, left_), last = cell(x + half_width, left_); c <= last; ++c) {
        const bool column_exists = c >= 0 && c < static_cast<std::int64_t>(columns_);
        for (std::size_t k = 0; k < count; ++k) {
            const auto r = low + static_cast<std::int64_t>(k);
            const bool exists = column_exists && r >= 0 && r < static_cast<std::int64_t>(rows_);
            column_sites_[k] = exists ? lattice_[static_cast<std::size_t>(c) * rows_ + static_cast<std::size_t>(r)] : no_site;
        }
        f(left_ + static_cast<double>(c) * side_, std::span<const double>(edges_), std::span<const std::uint32_t>(column_sites_));
    }
}

}  // namespace corpuscle
