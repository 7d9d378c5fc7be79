#pragma once
// A skin drawn as regions made of shapes, filled with sites.

#include <string>

#include "skin/sites.hpp"

namespace corpuscle {

/// One shape; lengths in m.
struct SkinShape {
    enum class Kind { strip, capsule, ellipse, polygon } kind;
    /// Of a strip and a capsule the ends of their middle line, of an ellipse its middle, of a polygon its corners.
    std::vector<Position> points;
    double width = 0;  ///< of a strip or capsule where it begins; of an ellipse
    double other = 0;  ///< of a strip or capsule where it ends; of an ellipse its height
    double turns = 0;  ///< of an ellipse: its width is turned so far from x, counter-clockwise

    bool holds(double x, double y) const;
    /// A box about it: {left, low} and {right, high}.
    std::pair<Position, Position> box() const;
};

struct SkinRegion {
    std::string name;
    std::vector<SkinShape> shapes;
};

/// Sites `pitch` apart in square cells, over all that the regions hold: a cell whose middle several regions hold is the first one's.
/// Each stands for pitch squared of skin. Refuses a region without a site.
Result<Sites> outline_sites(std::span<const SkinRegion>, double pitch);

}  // namespace corpuscle
