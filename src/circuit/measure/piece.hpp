#pragma once
// A curve between two points that follow each other. All that is said of what lies between them is said here: a straight line. A finer
// curve between them (an integrator's own) comes in here.

#include <algorithm>
#include <cmath>

namespace corpuscle::circuit {

struct Piece {
    double x0, y0, x1, y1;

    double length() const { return std::abs(x1 - x0); }
    bool holds(double x) const { return (x0 <= x && x <= x1) || (x1 <= x && x <= x0); }
    double at(double x) const { return x1 == x0 || x == x1 ? y1 : y0 + (y1 - y0) * (x - x0) / (x1 - x0); }
    double slope() const { return (y1 - y0) / (x1 - x0); }

    bool rises() const { return y0 < 0 && y1 >= 0; }
    bool falls() const { return y0 > 0 && y1 <= 0; }
    /// Where it is 0, if it rises or falls.
    double zero() const { return x0 + (x1 - x0) * (y0 / (y0 - y1)); }

    double integral() const { return 0.5 * (y0 + y1) * (x1 - x0); }
    /// Of the square, exactly.
    double squares() const { return (y0 * y0 + y0 * y1 + y1 * y1) / 3 * length(); }

    /// The part between two places; whether there is one.
    bool cut(double from, double to) {
        const double low = std::max(from, std::min(x0, x1)), high = std::min(to, std::max(x0, x1));
        if (!(low <= high)) return false;
        const bool back = x1 < x0;
        const double a = back ? high : low, b = back ? low : high;
        *this = {a, a == x0 ? y0 : at(a), b, at(b)};
        return true;
    }
};

}  // namespace corpuscle::circuit
