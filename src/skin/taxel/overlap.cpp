#include "skin/taxel/overlap.hpp"

#include <algorithm>
#include <cmath>

#include "core/number/elementary.hpp"

namespace corpuscle {
namespace {

/// The part of a polygon where a coordinate is at least `limit` (`sign` 1), or at most (`sign` -1). Sutherland and Hodgman's algorithm.
void cut(const ConvexPolygon& polygon, double Position::* coordinate, double limit, double sign, ConvexPolygon& out) {
    out.clear();
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const auto &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
        const double from = sign * (a.*coordinate - limit), to = sign * (b.*coordinate - limit);  // inside if not negative
        if (from >= 0) out.push_back(a);
        if ((from >= 0) == (to >= 0)) continue;
        const double fraction = from / (from - to);
        Position crossing{a.x + (b.x - a.x) * fraction, a.y + (b.y - a.y) * fraction, 0};
        crossing.*coordinate = limit;
        out.push_back(crossing);
    }
}

}  // namespace

ConvexPolygon rectangle(double width, double height) {
    const double x = width / 2, y = height / 2;
    return {{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}};
}

ConvexPolygon disc(double area) {
    constexpr int sides = 64;
    const double radius = num::sqrt(area / (0.5 * sides * num::sin_turns(1.0 / sides)));
    ConvexPolygon out;
    for (int k = 0; k < sides; ++k)
        out.push_back(
            {radius * num::cos_turns(static_cast<double>(k) / sides), radius * num::sin_turns(static_cast<double>(k) / sides), 0});
    return out;
}

double area_of(const ConvexPolygon& polygon) {
    double twice = 0;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        // Relative to the first corner, so that a polygon far from the origin loses no digits.
        const auto &origin = polygon[0], &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
        twice += (a.x - origin.x) * (b.y - origin.y) - (b.x - origin.x) * (a.y - origin.y);
    }
    return twice / 2;
}

Box bounding_box(const ConvexPolygon& polygon) {
    Box box{polygon[0].x, polygon[0].y, polygon[0].x, polygon[0].y};
    for (const auto& p : polygon) {
        box.left = std::min(box.left, p.x), box.right = std::max(box.right, p.x);
        box.low = std::min(box.low, p.y), box.high = std::max(box.high, p.y);
    }
    return box;
}

double overlap_area(const ConvexPolygon& polygon, const Box& box) {
    ConvexPolygon a, b;
    cut(polygon, &Position::x, box.left, 1, a);
    cut(a, &Position::x, box.right, -1, b);
    cut(b, &Position::y, box.low, 1, a);
    cut(a, &Position::y, box.high, -1, b);
    return b.size() < 3 ? 0 : std::max(0.0, area_of(b));
}

}  // namespace corpuscle
