#pragma once
// Finds the random factors that a measure depends on, and the fraction of the measure's variance due to each, by a linear regression on the
// significant factors.

#include <cstddef>
#include <span>
#include <vector>

#include "sweep/stats/estimate.hpp"

namespace corpuscle {

/// A random number on which a measure may depend, such as the mismatch of one transistor: its values for all items.
using SweepFactor = std::vector<double>;

/// A significant factor.
struct Influence {
    std::size_t factor = 0;  ///< index among the examined factors
    double slope = 0;        ///< change of the measure when the factor increases by one standard deviation
    Estimate fraction;       ///< fraction of the measure's variance due to this factor, minus the fraction expected by chance
    double p_value = 1;      ///< probability that a factor without effect seems at least as strong
};

struct Sensitivity {
    std::size_t items = 0, factors = 0;  ///< number of items with the measure, and number of examined factors
    double variance = 0;                 ///< of the measure
    /// Fraction of the variance that all influences together explain. The rest is due to nonlinear or joint effects, or noise.
    double explained = 0;
    std::vector<Influence> influences = {};  ///< the strongest first
};

/// Expected fraction of factors without effect among the reported ones, at most (false discovery rate of Benjamini and Hochberg).
inline constexpr double false_discovery_rate = 0.01;

/// `measure` and each factor have one number for each item; items whose measure is NaN are left out. In rounds, factors with a significant
/// correlation with the residual are added, then a regression on all added factors is computed. The test is exact for normally distributed
/// factors, and any distribution of the measure: the correlation of any given numbers with independent normal numbers, converted to t,
/// follows Student's distribution. `more`: further factors, whose indexes follow those of `factors`.
Sensitivity sensitivity_of(std::span<const double> measure, std::span<const SweepFactor> factors, std::span<const SweepFactor> more = {});

/// For each group, the mean and the number of its values that are finite.
struct GroupMeans {
    std::vector<double> means, counts;  ///< the mean of no values is NaN
};
/// `group`: for each value, the index of its group; a value whose index is not below `groups` is left out.
GroupMeans group_means(std::span<const double> values, std::span<const std::size_t> group, std::size_t groups);

/// The effect of groups, such as the points of an axis, on a measure: the fraction of the measure's variance that lies between the groups
/// (omega squared), and its p-value by Fisher's F.
struct GroupEffect {
    double fraction = 0, p_value = 1;
};
/// `group`: for each item, the index of its group; `groups`: their number. Without a value of the measure in two groups: fraction 0,
/// p-value 1.
GroupEffect group_effect(std::span<const double> measure, std::span<const std::size_t> group, std::size_t groups);

/// The factor by which the standard deviation of a measure changes if the gate area of a device is four times as large, which halves its
/// mismatch. `fraction_of_device`: fraction of the variance due to this device.
double relative_sigma_at_four_times_area(double fraction_of_device);

}  // namespace corpuscle
