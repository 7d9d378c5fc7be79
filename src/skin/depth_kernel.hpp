#pragma once
// The vertical stress at a depth below the skin, where the nerve endings are, from a pressure on the skin.

namespace corpuscle {

/// Boussinesq's solution for an elastic half space: a point force on the surface causes at the depth z and at the horizontal distance r the
/// vertical stress
///
///     force * 3 z^3 / (2 pi (r^2 + z^2)^(5/2))
///
/// It depends on no elastic constant, and its integral over the plane is 1. This class integrates it over rectangles exactly.
class DepthKernel {
    double depth_;  // z, m

public:
    explicit DepthKernel(double depth) : depth_(depth) {}
    double depth() const { return depth_; }

    /// The integral over the rectangle between (0, 0) and (x, y), m. It is odd in x and in y.
    double corner(double x, double y) const;

    /// Half the side of a square, m, outside which this fraction of the integral is left, if its centre is above the nerve ending.
    double reach(double fraction) const;
};

}  // namespace corpuscle
