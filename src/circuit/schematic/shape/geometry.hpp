#pragma once
// Points and boxes of a drawing. Coordinates are integers in user units of the SVG; y points down. Pins and wires are on a grid.

#include <algorithm>

namespace corpuscle::circuit::schematic {

inline constexpr int grid_step = 10;  ///< distance of neighbouring wires

struct Point {
    int x = 0, y = 0;
    bool operator==(const Point&) const = default;
};
inline Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }

/// The direction in which a pin leaves its symbol.
enum class Direction { left, right, up, down };
inline Point unit_of(Direction d) {
    return d == Direction::left ? Point{-1, 0} : d == Direction::right ? Point{1, 0} : d == Direction::up ? Point{0, -1} : Point{0, 1};
}

/// A rectangle with its edges; left > right: empty.
struct Box {
    int left = 1, top = 1, right = 0, bottom = 0;
    bool is_empty() const { return left > right || top > bottom; }
    bool overlaps(const Box& b) const {
        return !is_empty() && !b.is_empty() && left < b.right && b.left < right && top < b.bottom && b.top < bottom;
    }
    Box shifted(Point p) const { return is_empty() ? *this : Box{left + p.x, top + p.y, right + p.x, bottom + p.y}; }
    void include(const Box& b) {
        if (b.is_empty()) return;
        *this = is_empty() ? b : Box{std::min(left, b.left), std::min(top, b.top), std::max(right, b.right), std::max(bottom, b.bottom)};
    }
    void include(Point p) { include(Box{p.x, p.y, p.x, p.y}); }
};

/// The multiple of the grid step at or below, or at or above, a coordinate.
inline int grid_floor(int v) { return (v >= 0 ? v / grid_step : -((-v + grid_step - 1) / grid_step)) * grid_step; }
inline int grid_ceil(int v) { return -grid_floor(-v); }
inline int grid_round(int v) { return grid_floor(v + grid_step / 2); }

}  // namespace corpuscle::circuit::schematic
