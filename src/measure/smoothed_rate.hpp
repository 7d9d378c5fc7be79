#pragma once
// A spike train as a smooth curve, which changes smoothly when spikes move. The difference of two such curves is a distance that can be
// minimised, unlike the distances of train_distance.hpp, which have kinks where spikes meet.

#include <cmath>
#include <span>
#include <vector>

#include "core/number/elementary.hpp"

namespace corpuscle {

/// The points of time from, from + step ... at which a curve is computed; all in s.
struct TimeGrid {
    double from = 0, step = 1;
    std::size_t count = 0;
    double time(std::size_t k) const { return from + step * static_cast<double>(k); }
};

/// The sum of one Gaussian of standard deviation `width` (s) for each spike, scaled so that the sum of the squares of an isolated spike's
/// curve is 1. `grid.step` must not exceed `width`: then the sum of squares is the integral, up to rounding (the Gaussian kernel of
/// Schreiber et al. 2003, Neurocomputing 52-54:925, in the squared distance of van Rossum 2001).
inline std::vector<double> smoothed_rate(std::span<const double> train, const TimeGrid& grid, double width) {
    constexpr double reach = 6;  // standard deviations; the Gaussian is below 2e-8 of its peak beyond
    constexpr double root_pi = 1.7724538509055160273;
    const double scale = num::sqrt(grid.step / (width * root_pi));
    std::vector<double> out(grid.count);
    for (const double t : train) {
        const double first = std::ceil((t - reach * width - grid.from) / grid.step);
        const double last = std::floor((t + reach * width - grid.from) / grid.step);
        if (last < 0 || first >= static_cast<double>(grid.count)) continue;
        for (auto k = first > 0 ? static_cast<std::size_t>(first) : 0; k < grid.count && static_cast<double>(k) <= last; ++k) {
            const double z = (grid.time(k) - t) / width;
            out[k] += scale * num::exp(-0.5 * z * z);
        }
    }
    return out;
}

}  // namespace corpuscle
