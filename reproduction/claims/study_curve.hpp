#pragma once
// A curve as pairs of numbers (x, y), and functions that read values from it.

#include <vector>

namespace corpuscle {

/// Pairs in order of rising x. A function that returns a number returns NaN if the curve has no such value.
struct StudyCurve {
    std::vector<double> x, y;

    bool empty() const { return x.empty(); }
    /// y at at_x, by linear interpolation between two pairs; NaN beyond the ends.
    double at(double at_x) const;
    /// The first x, not below `from`, at which y reaches or crosses the level, by linear interpolation.
    double crossing(double level, double from = -1e300) const;
    /// dy/dx at every pair except the ends, from the parabola through the pair and its neighbours.
    StudyCurve slope() const;
    double slope_at(double at_x) const { return slope().at(at_x); }
    StudyCurve scaled(double x_factor, double y_factor) const;
    StudyCurve absolute() const;  ///< |y|
    StudyCurve inverse() const;   ///< 1/y
    /// The pairs with x from `from` to `to`, both included.
    StudyCurve between(double from, double to) const;
    /// The curve at equal steps of x from its first x on, by linear interpolation.
    StudyCurve resampled(double step) const;
    double min() const;  ///< smallest y
    double max() const;  ///< largest y
    /// The x of the largest y.
    double x_of_max() const;
    /// A straight line fitted by least squares.
    struct LineFit {
        double intercept, slope, max_deviation;  ///< max_deviation: the largest distance in y from the line
    };
    LineFit fit_line() const;
};

}  // namespace corpuscle
