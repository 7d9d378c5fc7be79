#include "skin/plan/sites.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "core/number/elementary.hpp"

namespace corpuscle {
namespace {

/// Coordinates of a point relative to the centre line of a strip.
struct StripPosition {
    double along;   ///< 0 at the first end of the centre line, 1 at the second
    double across;  ///< distance from the centre line, m; negative on one side
};

/// `s` is a strip or a capsule.
StripPosition strip_position(const SkinShape& s, double x, double y) {
    const double dx = s.points[1].x - s.points[0].x, dy = s.points[1].y - s.points[0].y, square = dx * dx + dy * dy;
    const double px = x - s.points[0].x, py = y - s.points[0].y;
    if (!(square > 0)) return {-1, 0};  // a centre line without length: the point is outside
    return {(px * dx + py * dy) / square, (px * dy - py * dx) / num::sqrt(square)};
}

bool in_strip(const SkinShape& s, double x, double y) {
    const auto at = strip_position(s, x, y);
    return at.along >= 0 && at.along <= 1 && 2 * std::abs(at.across) <= s.width + (s.end_width - s.width) * at.along;
}

bool in_disc(const Position& centre, double diameter, double x, double y) {
    const double dx = x - centre.x, dy = y - centre.y;
    return 4 * (dx * dx + dy * dy) <= diameter * diameter;
}

bool in_ellipse(const SkinShape& s, double x, double y) {
    const double dx = x - s.points[0].x, dy = y - s.points[0].y, c = num::cos_turns(s.turns), n = num::sin_turns(s.turns);
    const double u = 2 * (dx * c + dy * n) / s.width, v = 2 * (dy * c - dx * n) / s.end_width;
    return u * u + v * v <= 1;
}

/// True if a line from the point to the right crosses an odd number of edges.
bool in_polygon(const SkinShape& s, double x, double y) {
    bool inside = false;
    for (std::size_t k = 0, last = s.points.size() - 1; k < s.points.size(); last = k++) {
        const auto &a = s.points[k], &b = s.points[last];
        if ((a.y > y) != (b.y > y) && x < (b.x - a.x) * (y - a.y) / (b.y - a.y) + a.x) inside = !inside;
    }
    return inside;
}

/// Square cells over the bounding box of all regions. Their edges are at multiples of the pitch.
struct Lattice {
    double pitch, left, low;  ///< pitch: side of a cell, m; left, low: left and lower edge of the first cell, in multiples of pitch
    std::size_t columns, rows;
    std::vector<std::int32_t> region;  ///< of each cell, row by row from below: index of its region; -1: none

    /// x of the centre of column c, and y of the centre of row r, m.
    double x(std::size_t c) const { return (left + static_cast<double>(c) + 0.5) * pitch; }
    double y(std::size_t r) const { return (low + static_cast<double>(r) + 0.5) * pitch; }
    /// The columns (or rows) [begin, end) that contain the interval from `from` to `to`, limited to `count` columns. `first` is the left
    /// edge of column 0; all positions are in multiples of pitch.
    static std::pair<std::size_t, std::size_t> cells_between(double from, double to, double first, std::size_t count) {
        const auto cell = [&](double at) { return static_cast<std::size_t>(std::clamp(at - first, 0.0, static_cast<double>(count))); };
        return {cell(std::floor(from)), cell(std::floor(to) + 1)};
    }
};

Result<Lattice> lattice_over(std::span<const SkinRegion> regions, double pitch) {
    double left = INFINITY, low = INFINITY, right = -INFINITY, high = -INFINITY;
    for (const auto& r : regions)
        for (const auto& s : r.shapes) {
            const auto [from, to] = s.bounding_box();
            left = std::min(left, from.x), low = std::min(low, from.y), right = std::max(right, to.x), high = std::max(high, to.y);
        }
    if (!(right > left && high > low)) return bad_input("the regions have no area");
    Lattice out{pitch, std::floor(left / pitch), std::floor(low / pitch), 0, 0, {}};
    const double columns = std::floor(right / pitch) - out.left + 1, rows = std::floor(high / pitch) - out.low + 1;
    if (!(columns * rows <= static_cast<double>(max_sites)))
        return bad_input(fmt::format("{:g} by {:g} m of skin with a site every {:g} m is more than {} sites; raise the pitch", right - left,
                                     high - low, pitch, max_sites));
    out.columns = static_cast<std::size_t>(columns), out.rows = static_cast<std::size_t>(rows);
    out.region.assign(out.columns * out.rows, -1);
    return out;
}

/// Assigns the cells whose centre is in a shape to a region, unless they belong to an earlier one.
void fill(Lattice& lattice, const SkinShape& shape, std::int32_t region) {
    const auto [from, to] = shape.bounding_box();
    const auto across = Lattice::cells_between(from.x / lattice.pitch, to.x / lattice.pitch, lattice.left, lattice.columns);
    const auto up = Lattice::cells_between(from.y / lattice.pitch, to.y / lattice.pitch, lattice.low, lattice.rows);
    for (auto r = up.first; r < up.second; ++r)
        for (auto c = across.first; c < across.second; ++c)
            if (auto& cell = lattice.region[r * lattice.columns + c]; cell < 0 && shape.contains(lattice.x(c), lattice.y(r))) cell = region;
}

}  // namespace

bool SkinShape::contains(double x, double y) const {
    switch (kind) {
        case Kind::strip:
            return in_strip(*this, x, y);
        case Kind::capsule:
            return in_strip(*this, x, y) || in_disc(points[0], width, x, y) || in_disc(points[1], end_width, x, y);
        case Kind::ellipse:
            return in_ellipse(*this, x, y);
        case Kind::polygon:
            return in_polygon(*this, x, y);
    }
    return false;
}

std::pair<Position, Position> SkinShape::bounding_box() const {
    Position from = points[0], to = points[0];
    for (const auto& p : points)
        from.x = std::min(from.x, p.x), from.y = std::min(from.y, p.y), to.x = std::max(to.x, p.x), to.y = std::max(to.y, p.y);
    const double half_width = kind == Kind::polygon ? 0 : 0.5 * std::max(width, end_width);
    return {{from.x - half_width, from.y - half_width, 0}, {to.x + half_width, to.y + half_width, 0}};
}

Result<Sites> fill_regions(std::span<const SkinRegion> regions, double pitch) {
    auto lattice = TRY(lattice_over(regions, pitch));
    Sites out;
    out.area = pitch * pitch;
    out.shapes.assign(regions.begin(), regions.end());
    std::int32_t number = 0;
    for (const auto& r : regions) {
        out.regions.push_back(r.name);
        for (const auto& s : r.shapes) fill(lattice, s, number);
        ++number;
    }
    std::vector<std::size_t> count(regions.size());
    for (std::size_t k = 0; k < lattice.region.size(); ++k) {
        if (lattice.region[k] < 0) continue;
        const auto region = static_cast<std::size_t>(lattice.region[k]);
        out.positions.push_back({lattice.x(k % lattice.columns), lattice.y(k / lattice.columns), 0});
        out.region.push_back(static_cast<std::uint32_t>(region));
        out.names.push_back(fmt::format("{}.{}", regions[region].name, ++count[region]));
    }
    for (std::size_t r = 0; r < regions.size(); ++r)
        if (count[r] == 0)
            return bad_input(
                fmt::format("region '{}' has no site: it is smaller than the pitch, or earlier regions cover all of it", regions[r].name));
    return out;
}

}  // namespace corpuscle
