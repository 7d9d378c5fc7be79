#pragma once
// Finds the sampled factors that a measure depends on, and the fraction of its variance due to each: a linear regression on those factors
// that are significant.

#include <cstddef>
#include <span>
#include <vector>

#include "study/sweep/estimate.hpp"

namespace corpuscle {

/// A factor that a measure may depend on: one number for each item.
using SweepFactor = std::vector<double>;

/// A significant factor.
struct Influence {
    std::size_t factor = 0;
    double slope = 0;    ///< change of the measure for one standard deviation of the factor
    Estimate fraction;   ///< fraction of the measure's variance, minus what is expected by chance
    double p_value = 1;  ///< probability that a factor without effect is as strong
};

struct Sensitivity {
    std::size_t items = 0, factors = 0;      ///< examined items and factors
    double variance = 0;                     ///< of the measure
    double explained = 0;  ///< fraction explained by all influences together; the rest is due to nonlinear or joint effects, or noise
    std::vector<Influence> influences = {};  ///< the strongest first
};

/// Fraction of the reported factors that may have no effect (false discovery rate of Benjamini and Hochberg).
inline constexpr double false_discovery_rate = 0.01;

/// `measure` and each factor have one number for each item; items whose measure is NaN are left out. In rounds, factors with a significant
/// correlation with the residual are added, then a regression on all added factors is computed. The significance is exact for a factor that
/// is a normal deviate, for any distribution of the measure: given the measure, the correlation with independent normal numbers follows
/// Student's t.
Sensitivity sensitivity_of(std::span<const double> measure, std::span<const SweepFactor> factors);

/// Effect of a grid's points: the fraction of the variance between groups (omega squared), and its significance by Fisher's F.
struct GroupEffect {
    double fraction = 0, p_value = 1;
};
GroupEffect group_effect(std::span<const double> measure, std::span<const std::size_t> group, std::size_t groups);

/// The factor by which the standard deviation of a measure changes if the gate area of a device is four times as large, which halves its
/// mismatch. `fraction_of_device`: fraction of the variance due to this device.
double relative_sigma_at_four_times_area(double fraction_of_device);

}  // namespace corpuscle
