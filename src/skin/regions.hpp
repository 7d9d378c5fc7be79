#pragma once
// A skin described by regions made of shapes, which is filled with sites.

#include <string>

#include "skin/sites.hpp"

namespace corpuscle {

/// One shape; lengths in m.
struct SkinShape {
    enum class Kind { strip, capsule, ellipse, polygon } kind;
    /// The ends of the centre line for a strip and a capsule, the centre of an ellipse, the corners of a polygon.
    std::vector<Position> points;
    double width = 0;      ///< of a strip or capsule at its beginning; of an ellipse
    double end_width = 0;  ///< of a strip or capsule at its end; height of an ellipse
    double turns = 0;      ///< of an ellipse: angle from the x axis to the axis of `width`, counter-clockwise, in turns

    bool contains(double x, double y) const;
    /// A bounding box: {left, low} and {right, high}.
    std::pair<Position, Position> bounding_box() const;
};

struct SkinRegion {
    std::string name;
    std::vector<SkinShape> shapes;
};

/// Sites in square cells `pitch` apart, over the area of all regions. A cell whose centre is in several regions belongs to the first. Each
/// site represents pitch squared of skin. Refuses a region without a site.
Result<Sites> fill_regions(std::span<const SkinRegion>, double pitch);

}  // namespace corpuscle
