#include "skin/taxel/taxel_placement.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "core/number/elementary.hpp"
#include "core/parameter.hpp"
#include "core/text/ascii_text.hpp"
#include "skin/contact/skin_cells.hpp"
#include "skin/taxel/overlap.hpp"

namespace corpuscle {
namespace {

constexpr double min_overlap = 1e-9;  // of a taxel with a cell, as a fraction of the smaller of both; less is rounding

class TaxelPlacer {
    const Sites& sites_;
    SkinCells cells_;
    SiteGrid grid_;
    Box skin_;                       // box around all cells
    std::vector<Position> middles_;  // of the regions, m

    Box cell_of(const Position& site) const {
        const double half = cells_.side() / 2;
        return {site.x - half, site.y - half, site.x + half, site.y + half};
    }

    /// The origin of a patch on the skin.
    Result<Position> origin_of(const Taxel& taxel) const {
        if (taxel.pose.region.empty()) return taxel.pose.shift;
        const auto found = std::find(sites_.regions.begin(), sites_.regions.end(), taxel.pose.region);
        if (found == sites_.regions.end()) {
            const std::vector<std::string_view> names(sites_.regions.begin(), sites_.regions.end());
            return bad_input(fmt::format("taxel '{}': there is no region '{}'{}; the regions are {}", taxel.name, taxel.pose.region,
                                         did_you_mean(taxel.pose.region, names), joined(std::span<const std::string_view>(names))),
                             {taxel.location.file, taxel.location.line});
        }
        const auto& middle = middles_[static_cast<std::size_t>(found - sites_.regions.begin())];
        return Position{middle.x + taxel.pose.shift.x, middle.y + taxel.pose.shift.y, 0};
    }

    /// The error for a taxel that is completely off the skin.
    Error off_skin(const Taxel& taxel, const Position& centre) const {
        const auto site = grid_.nearest(centre.x, centre.y);
        const auto& at = sites_.positions[site];
        const auto& region = sites_.regions[sites_.region[site]];
        const auto& middle = middles_[sites_.region[site]];
        return bad_input(
            fmt::format("taxel '{}' is at ({:.4g}, {:.4g}) mm, off the skin; the nearest region is {}, {:.3g} mm away, with its "
                        "centre at ({:.4g}, {:.4g}) mm; move the taxel, or place its patch by the column region, as region = {}",
                        taxel.name, 1e3 * centre.x, 1e3 * centre.y, region, 1e3 * distance_between(at, centre), 1e3 * middle.x,
                        1e3 * middle.y, region),
            taxel.location);
    }

    /// Adds the overlaps of a taxel with its area.
    void add_overlaps(const ConvexPolygon& shape, PlacedTaxel& placed) {
        auto box = bounding_box(shape);
        box = {std::max(box.left, skin_.left), std::max(box.low, skin_.low), std::min(box.right, skin_.right),
               std::min(box.high, skin_.high)};
        if (!(box.left < box.right && box.low < box.high)) return;
        const double side = cells_.side(), area = area_of(shape), least = min_overlap * std::min(side * side, area);
        double on_skin = 0;
        const auto add_column = [&](double left, std::span<const double> edges, std::span<const std::uint32_t> column) {
            for (std::size_t k = 0; k < column.size(); ++k) {
                if (column[k] == SkinCells::no_site) continue;
                const double overlap = overlap_area(shape, {left, edges[k], left + side, edges[k + 1]});
                if (overlap > least) placed.overlaps.emplace_back(column[k], overlap), on_skin += overlap;
            }
        };
        cells_.for_each_column((box.left + box.right) / 2, (box.low + box.high) / 2, (box.right - box.left) / 2, (box.high - box.low) / 2,
                               add_column);
        std::sort(placed.overlaps.begin(), placed.overlaps.end());
        placed.fraction_on_skin = on_skin / area;
    }

    /// Adds the site in whose cell a point is.
    void add_point(PlacedTaxel& placed) const {
        const auto site = grid_.nearest(placed.centre.x, placed.centre.y);
        const auto& at = sites_.positions[site];
        const double reach = cells_.side() / 2 * (1 + min_overlap);
        if (std::abs(at.x - placed.centre.x) <= reach && std::abs(at.y - placed.centre.y) <= reach) placed.overlaps.emplace_back(site, 1);
    }

public:
    explicit TaxelPlacer(const Sites& sites) : sites_(sites), cells_(sites), grid_(sites.positions), middles_(sites.regions.size()) {
        std::vector<double> counts(sites.regions.size());
        skin_ = cell_of(sites.positions[0]);
        for (std::size_t s = 0; s < sites.size(); ++s) {
            auto& middle = middles_[sites.region[s]];
            middle.x += sites.positions[s].x, middle.y += sites.positions[s].y, counts[sites.region[s]] += 1;
            const auto cell = cell_of(sites.positions[s]);
            skin_ = {std::min(skin_.left, cell.left), std::min(skin_.low, cell.low), std::max(skin_.right, cell.right),
                     std::max(skin_.high, cell.high)};
        }
        for (std::size_t r = 0; r < counts.size(); ++r) middles_[r].x /= counts[r], middles_[r].y /= counts[r];
    }

    Result<PlacedTaxel> place(const Taxel& taxel) {
        const auto origin = TRY(origin_of(taxel));
        const double c = num::cos_turns(taxel.pose.rotation), s = num::sin_turns(taxel.pose.rotation);
        const auto on_skin = [&](double x, double y) { return Position{origin.x + c * x - s * y, origin.y + s * x + c * y, 0}; };
        PlacedTaxel placed{on_skin(taxel.x, taxel.y), {}};
        if (taxel.area > 0) {
            auto shape = taxel.width > 0 ? rectangle(taxel.width, taxel.height) : disc(taxel.area);
            for (auto& corner : shape) corner = on_skin(taxel.x + corner.x, taxel.y + corner.y);
            add_overlaps(shape, placed);
        } else {
            add_point(placed);
        }
        if (placed.overlaps.empty()) return off_skin(taxel, placed.centre);
        return placed;
    }
};

}  // namespace

double distance_between(const Position& a, const Position& b) {
    const double dx = a.x - b.x, dy = a.y - b.y;
    return num::sqrt(dx * dx + dy * dy);
}

Result<std::vector<PlacedTaxel>> place_taxels(const TaxelLayout& layout, const Sites& sites) {
    TaxelPlacer placer(sites);
    std::vector<PlacedTaxel> out;
    for (const auto& taxel : layout.taxels) out.push_back(TRY(placer.place(taxel)));
    return out;
}

}  // namespace corpuscle
