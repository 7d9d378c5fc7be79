#include "skin/plan/skin_outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace corpuscle {
namespace {

/// Samples of a skin on a grid with a margin that no shape reaches.
struct SampleGrid {
    std::span<const SkinRegion> regions;
    double left, low, step;  // m
    std::size_t columns, rows;
    std::vector<std::size_t> region;  // of each sample, row by row from below

    double x(std::size_t column) const { return left + step * static_cast<double>(column); }
    double y(std::size_t row) const { return low + step * static_cast<double>(row); }
    /// The index of the first region that contains a point; the number of regions if none does.
    std::size_t region_at(double px, double py) const {
        const auto has_point = [&](const SkinRegion& one) {
            return std::ranges::any_of(one.shapes, [&](const SkinShape& shape) { return shape.contains(px, py); });
        };
        return static_cast<std::size_t>(std::ranges::find_if(regions, has_point) - regions.begin());
    }
};

SampleGrid sample(const Sites& sites, double step) {
    double left = INFINITY, low = INFINITY, right = -INFINITY, high = -INFINITY;
    for (const auto& region : sites.shapes)
        for (const auto& shape : region.shapes) {
            const auto [from, to] = shape.bounding_box();
            left = std::min(left, from.x), low = std::min(low, from.y), right = std::max(right, to.x), high = std::max(high, to.y);
        }
    const auto count = [&](double length) { return static_cast<std::size_t>(std::ceil(length / step)) + 5; };
    SampleGrid out{sites.shapes, left - 2 * step, low - 2 * step, step, count(right - left), count(high - low), {}};
    for (std::size_t r = 0; r < out.rows; ++r)
        for (std::size_t c = 0; c < out.columns; ++c) out.region.push_back(out.region_at(out.x(c), out.y(r)));
    return out;
}

/// Marching squares: the curves around the regions first ... last.
class ContourTracer {
public:
    ContourTracer(const SampleGrid& grid, std::size_t first, std::size_t last) : grid_(grid), first_(first), last_(last) {
        next_.assign(2 * grid.region.size(), none);
        for (std::size_t r = 0; r + 1 < grid.rows; ++r)
            for (std::size_t c = 0; c + 1 < grid.columns; ++c) link_cell(r * grid.columns + c);
    }

    std::vector<Polygon> curves() {
        std::vector<Polygon> out;
        for (std::size_t first = 0; first < next_.size(); ++first) {
            if (next_[first] == none) continue;
            Polygon curve;
            for (auto edge = first; next_[edge] != none;) {
                curve.push_back(crossing(edge));
                edge = std::exchange(next_[edge], none);
            }
            out.push_back(curve);
        }
        return out;
    }

private:
    static constexpr std::size_t none = static_cast<std::size_t>(-1);
    const SampleGrid& grid_;
    std::size_t first_, last_;
    std::vector<std::size_t> next_;  // the edge after each edge on a curve. Edge 2 k is right of sample k, edge 2 k + 1 is above it

    bool is_inside(std::size_t region) const { return region >= first_ && region <= last_; }
    bool is_sample_inside(std::size_t k) const { return is_inside(grid_.region[k]); }

    /// Links the edges of the cell above and to the right of sample k. The inside is to the left of a curve.
    void link_cell(std::size_t k) {
        const auto up = k + grid_.columns;
        const std::array corners{is_sample_inside(k), is_sample_inside(k + 1), is_sample_inside(up + 1),
                                 is_sample_inside(up)};                     // counter-clockwise
        const std::array edges{2 * k, 2 * (k + 1) + 1, 2 * up, 2 * k + 1};  // edge n is after corner n
        for (std::size_t n = 0; n < 4; ++n) {
            if (!corners[n] || corners[(n + 1) % 4]) continue;  // a curve enters the cell where the corners change from inside to outside
            std::size_t m = (n + 3) % 4;
            while (corners[m] || !corners[(m + 1) % 4]) m = (m + 3) % 4;
            next_[edges[n]] = edges[m];
        }
    }

    /// The place of the curve on an edge, by bisection.
    Position crossing(std::size_t edge) const {
        const auto k = edge / 2;
        const double dx = edge % 2 ? 0 : grid_.step, dy = edge % 2 ? grid_.step : 0, x = grid_.x(k % grid_.columns),
                     y = grid_.y(k / grid_.columns);
        double low = 0, high = 1;
        for (int n = 0; n < 8; ++n) {
            const double middle = 0.5 * (low + high);
            (is_inside(grid_.region_at(x + middle * dx, y + middle * dy)) == is_sample_inside(k) ? low : high) = middle;
        }
        return {x + low * dx, y + low * dy, 0};
    }
};

/// Replaces each point by the mean of itself and its neighbours, several times. Removes the small steps where two shapes meet, and rounds
/// corners.
Polygon smoothed(Polygon curve, int times) {
    for (int n = 0; n < times; ++n) {
        Polygon out;
        for (std::size_t k = 0; k < curve.size(); ++k) {
            const auto &a = curve[(k + curve.size() - 1) % curve.size()], &b = curve[k], &c = curve[(k + 1) % curve.size()];
            out.push_back({(a.x + 2 * b.x + c.x) / 4, (a.y + 2 * b.y + c.y) / 4, 0});
        }
        curve = std::move(out);
    }
    return curve;
}

/// Removes points that are nearer than `tolerance` (m) to the line from the point kept before them to the next point.
Polygon simplified(const Polygon& curve, double tolerance) {
    Polygon out;
    for (std::size_t k = 0; k < curve.size(); ++k) {
        const auto &a = out.empty() ? curve.back() : out.back(), &b = curve[k], &c = curve[(k + 1) % curve.size()];
        const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x), length = std::hypot(c.x - a.x, c.y - a.y);
        if (std::abs(area) > tolerance * length || std::hypot(b.x - a.x, b.y - a.y) > 500 * tolerance) out.push_back(b);
    }
    return out;
}

std::vector<Polygon> curves_around(const SampleGrid& grid, std::size_t first, std::size_t last, int smoothings) {
    std::vector<Polygon> out;
    for (const auto& curve : ContourTracer(grid, first, last).curves())
        if (auto points = simplified(smoothed(curve, smoothings), 0.01 * grid.step); points.size() > 2) out.push_back(std::move(points));
    return out;
}

}  // namespace

SkinOutline skin_outline(const Sites& sites) {
    SkinOutline out;
    if (sites.shapes.empty()) return out;
    const auto grid = sample(sites, 0.5 * std::sqrt(sites.area));
    out.skin = curves_around(grid, 0, sites.shapes.size() - 1, 14);
    for (std::size_t r = 0; r < sites.shapes.size(); ++r) out.regions.push_back(curves_around(grid, r, r, 2));
    return out;
}

}  // namespace corpuscle
