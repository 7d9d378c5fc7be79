#pragma once
// A curve as pairs of numbers, and values read from it.

#include <vector>

namespace corpuscle {

/// Pairs with rising x. Functions return NaN if there is nothing to read.
struct Line {
    std::vector<double> x, y;

    bool empty() const { return x.empty(); }
    /// Linear interpolation between two pairs; NaN beyond the ends.
    double at(double place) const;
    /// The first x, from `from` on, at which y crosses the level.
    double where(double level, double from = -1e300) const;
    /// dy/dx at every pair except the ends, from the parabola through the pair and its neighbours.
    Line slope() const;
    double slope_at(double place) const { return slope().at(place); }
    Line times(double of_x, double of_y) const;
    Line absolute() const;
    Line inverse() const;  ///< 1/y
    /// The pairs from one x to another.
    Line between(double from, double to) const;
    /// Resampled at equal steps from its first x on.
    Line every(double step) const;
    double least() const;
    double most() const;
    /// The x of the largest y.
    double peak() const;
    /// A straight line fitted by least squares.
    struct Straight {
        double at_zero, slope, farthest;  ///< farthest: the largest distance in y from the line
    };
    Straight straight() const;
};

}  // namespace corpuscle
