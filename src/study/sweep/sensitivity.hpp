#pragma once
// Which of what was drawn a measure depends on, and what share of its variance each brings: a straight line through the results of a
// sweep, with those factors alone that stand out of the noise.

#include <cstddef>
#include <span>
#include <vector>

#include "study/sweep/estimate.hpp"

namespace corpuscle {

/// What a measure may depend on: a number a unit.
using SweepFactor = std::vector<double>;

/// A factor that is found to matter.
struct Influence {
    std::size_t factor = 0;
    double slope = 0;   ///< of the measure, for one deviation of the factor
    Estimate share;     ///< of the measure's variance; less what chance alone would bring
    double chance = 1;  ///< how often a factor that does nothing would look as strong
};

struct Sensitivity {
    std::size_t units = 0, factors = 0;      ///< that were looked at
    double variance = 0;                     ///< of the measure
    double explained = 0;                    ///< share of it that the influences bring together; the rest is bent, is joint or is noise
    std::vector<Influence> influences = {};  ///< the strongest first
};

/// Of factors that do nothing, so many of those found may be among them (Benjamini and Hochberg's rate of false discoveries).
inline constexpr double false_discoveries = 0.01;

/// `measure` and each factor: as many numbers as there are units; a unit whose measure is NaN is left out. In rounds: of all factors the
/// ones are taken whose correlation with what is not yet explained is beyond chance; then a plane is laid through all that were taken.
/// For a factor that is a normal deviate the chance is exact however the measure is distributed: given the measure, the correlation of
/// independent normal numbers follows Student's t.
Sensitivity sensitivity_of(std::span<const double> measure, std::span<const SweepFactor> factors);

/// What points of a grid bring: the share of the variance that lies between groups (omega squared), and its chance by Fisher's F.
struct Between {
    double share = 0, chance = 1;
};
Between between_groups(std::span<const double> measure, std::span<const std::size_t> group, std::size_t groups);

/// A measure's deviation once the gate area of a device is 4 times as large, its own deviates half: as a part of what it is.
double sigma_with_four_times_the_area(double share_of_device);

}  // namespace corpuscle
