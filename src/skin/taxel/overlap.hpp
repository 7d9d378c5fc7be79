#pragma once
// The overlap of a convex polygon with a box: how much of a taxel is in a cell of skin.

#include <vector>

#include "core/force_source.hpp"

namespace corpuscle {

/// A box with edges along the axes.
struct Box {
    double left, low, right, high;
};

/// Corners of a convex polygon, counter-clockwise.
using ConvexPolygon = std::vector<Position>;

/// A rectangle around (0, 0).
ConvexPolygon rectangle(double width, double height);
/// A regular polygon of 64 sides around (0, 0) with this area, instead of a disc.
ConvexPolygon disc(double area);

double area_of(const ConvexPolygon&);
Box bounding_box(const ConvexPolygon&);
/// The area of the part of the polygon that is in the box.
double overlap_area(const ConvexPolygon&, const Box&);

}  // namespace corpuscle
