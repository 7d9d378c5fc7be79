#pragma once
// A curve between two consecutive points. All interpolation of measurements is done here, and it is linear; a finer interpolation, such
// as the integrator's own, would be added here.

#include <algorithm>
#include <cmath>

namespace corpuscle::circuit {

struct LineSegment {
    double x0, y0, x1, y1;

    double length() const { return std::abs(x1 - x0); }
    bool contains(double x) const { return (x0 <= x && x <= x1) || (x1 <= x && x <= x0); }
    double at(double x) const { return x1 == x0 || x == x1 ? y1 : y0 + (y1 - y0) * (x - x0) / (x1 - x0); }
    double slope() const { return (y1 - y0) / (x1 - x0); }

    bool rises() const { return y0 < 0 && y1 >= 0; }
    bool falls() const { return y0 > 0 && y1 <= 0; }
    /// The position of the zero, if the segment rises or falls through 0.
    double zero() const { return x0 + (x1 - x0) * (y0 / (y0 - y1)); }

    double integral() const { return 0.5 * (y0 + y1) * (x1 - x0); }
    /// The integral of the square, exact.
    double integral_of_square() const { return (y0 * y0 + y0 * y1 + y1 * y1) / 3 * length(); }

    /// Cuts the segment to the interval. Returns false if nothing of it lies inside.
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
