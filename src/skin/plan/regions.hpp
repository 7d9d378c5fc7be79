#pragma once
// A skin as a set of regions, each made of shapes. The regions are filled with sites.

#include "skin/plan/sites.hpp"

namespace corpuscle {

/// One shape of a region; lengths in m. A strip has two straight sides and, at both ends of its centre line, a width; a capsule is a strip
/// with a round end at each end of its centre line.
struct SkinShape {
    enum class Kind { strip, capsule, ellipse, polygon } kind;
    /// The ends of the centre line for a strip and a capsule, the centre of an ellipse, the corners of a polygon.
    std::vector<Position> points;
    double width = 0;      ///< width of an ellipse, or of a strip or capsule at the first point
    double end_width = 0;  ///< height of an ellipse, or width of a strip or capsule at the second point
    double turns = 0;      ///< of an ellipse: angle from the x axis to the axis of `width`, counter-clockwise, in turns

    bool contains(double x, double y) const;
    /// The corners {left, low} and {right, high} of a box that contains the shape.
    std::pair<Position, Position> bounding_box() const;
};

/// A named part of a skin: the union of its shapes.
struct SkinRegion {
    std::string name;
    std::vector<SkinShape> shapes;
};

/// Divides the plane into square cells of side `pitch` (m), and places a site at the centre of each cell whose centre is in a region. A
/// centre that is in several regions belongs to the first of them. Each site represents pitch squared of skin. A region without a site is
/// an error.
Result<Sites> fill_regions(std::span<const SkinRegion>, double pitch);

}  // namespace corpuscle
