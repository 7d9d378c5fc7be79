#pragma once
// A curve as pairs of numbers, and what people read off one.

#include <vector>

namespace corpuscle {

/// Pairs, x rising. What is read off is NaN where there is nothing to read.
struct Line {
    std::vector<double> x, y;

    bool empty() const { return x.empty(); }
    /// Between two pairs a straight line; beyond the ends NaN.
    double at(double place) const;
    /// The first x, from `from` on, at which y passes through the level.
    double where(double level, double from = -1e300) const;
    /// dy/dx at every pair but the ends: of the parabola through it and its neighbours.
    Line slope() const;
    double slope_at(double place) const { return slope().at(place); }
    Line times(double of_x, double of_y) const;
    Line absolute() const;
    Line inverse() const;  ///< 1/y
    /// The pairs from one x to another.
    Line between(double from, double to) const;
    /// At even steps from its first x on.
    Line every(double step) const;
    double least() const;
    double most() const;
    /// The x of the largest y.
    double peak() const;
    /// The straight line that comes nearest, by least squares.
    struct Straight {
        double at_zero, slope, farthest;  ///< farthest: the largest distance in y from it
    };
    Straight straight() const;
};

}  // namespace corpuscle
