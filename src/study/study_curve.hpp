#pragma once
// A curve as pairs of numbers, and values read from it.

#include <vector>

namespace corpuscle {

/// Pairs with rising x. Functions return NaN if the curve has no such value.
struct StudyCurve {
    std::vector<double> x, y;

    bool empty() const { return x.empty(); }
    /// Linear interpolation between two pairs; NaN beyond the ends.
    double at(double at_x) const;
    /// The first x, from `from` on, at which y crosses the level.
    double crossing(double level, double from = -1e300) const;
    /// dy/dx at every pair except the ends, from the parabola through the pair and its neighbours.
    StudyCurve slope() const;
    double slope_at(double at_x) const { return slope().at(at_x); }
    StudyCurve scaled(double x_factor, double y_factor) const;
    StudyCurve absolute() const;
    StudyCurve inverse() const;  ///< 1/y
    /// The pairs from one x to another.
    StudyCurve between(double from, double to) const;
    /// Resampled at equal steps from its first x on.
    StudyCurve resampled(double step) const;
    double min() const;
    double max() const;
    /// The x of the largest y.
    double x_of_max() const;
    /// A straight line fitted by least squares.
    struct LineFit {
        double intercept, slope, max_deviation;  ///< max_deviation: the largest distance in y from the line
    };
    LineFit fit_line() const;
};

}  // namespace corpuscle
