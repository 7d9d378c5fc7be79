#pragma once
// A curve between two consecutive points, as a straight line. All interpolation of measurements is done here.

#include <algorithm>
#include <cmath>

namespace corpuscle::circuit {

/// From (x0, y0) to (x1, y1). x1 may be below x0, since .dc can sweep downwards.
struct LineSegment {
    double x0, y0, x1, y1;

    /// Along x.
    double length() const { return std::abs(x1 - x0); }
    bool contains(double x) const { return (x0 <= x && x <= x1) || (x1 <= x && x <= x0); }
    double at(double x) const { return x1 == x0 || x == x1 ? y1 : y0 + (y1 - y0) * (x - x0) / (x1 - x0); }
    double slope() const { return (y1 - y0) / (x1 - x0); }

    // Crossings of y = 0.
    bool rises() const { return y0 < 0 && y1 >= 0; }
    bool falls() const { return y0 > 0 && y1 <= 0; }
    /// The x at which y = 0, if the segment rises or falls.
    double zero() const { return x0 + (x1 - x0) * (y0 / (y0 - y1)); }

    /// Over dx, so the sign is that of x1 - x0.
    double integral() const { return 0.5 * (y0 + y1) * (x1 - x0); }
    /// The integral of y^2 over |dx|.
    double integral_of_square() const { return (y0 * y0 + y0 * y1 + y1 * y1) / 3 * length(); }

    /// Cuts the segment to from <= x <= to. Returns false if no part of it lies there.
    bool cut(double from, double to) {
        const double low = std::max(from, std::min(x0, x1)), high = std::min(to, std::max(x0, x1));
        if (!(low <= high)) return false;
        const bool is_backward = x1 < x0;
        const double a = is_backward ? high : low, b = is_backward ? low : high;
        *this = {a, a == x0 ? y0 : at(a), b, at(b)};
        return true;
    }
};

}  // namespace corpuscle::circuit
