#pragma once
// Estimates of the distribution behind a sample, each with its 95 % confidence interval.

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace corpuscle {

inline constexpr double confidence = 0.95;  ///< of all intervals

/// An estimated number and its confidence interval. A member is NaN if the sample is too small to estimate it.
struct Estimate {
    static constexpr double none = std::numeric_limits<double>::quiet_NaN();
    double value = none, low = none, high = none;
};

/// The proportion count / total with the interval of Clopper and Pearson. Its coverage is never below the confidence level, even if
/// `count` is 0 or `total`. (Wilson's interval is narrower, but its coverage can be lower.)
Estimate estimate_proportion(std::int64_t count, std::int64_t total);

/// Numbers in ascending order, with estimates of the distribution from which they come. Here a sample is all these numbers.
class SortedSample {
    std::vector<double> values_;
    double mean_ = Estimate::none;
    double squares_ = 0;  // sum of the squared deviations from the mean
    double fourths_ = 0;  // sum of the fourth powers of the deviations from a trimmed mean, for sigma()
    void compute_moments();

    SortedSample() = default;

public:
    /// NaNs are left out.
    explicit SortedSample(std::vector<double> values);
    /// One sample with the numbers of all these samples.
    static SortedSample merged(const std::vector<SortedSample>&);
    std::size_t count() const { return values_.size(); }
    const std::vector<double>& values() const { return values_; }

    /// The mean, with the interval of Student's t.
    Estimate mean() const;
    /// Standard deviation with the divisor n - 1, and the interval of Bonett (2006), which uses the sample's kurtosis. The chi-squared
    /// interval assumes a normal distribution and is far too narrow for long tails, such as those of a chip's spike count. A bootstrap
    /// costs 1000 times as much.
    Estimate sigma() const;
    /// Quantile, 0 <= q <= 1, interpolated between order statistics (sorted values) as by default in R and numpy. Each end of the interval
    /// is an order statistic, chosen by the binomial distribution, so that the interval is valid for any distribution of the values.
    Estimate quantile(double q) const;
    /// Correlation coefficient of a normal probability plot (Filliben 1975; plotting positions after Blom), with at most 1000 points; 1 if
    /// the plot is a straight line, as for a large normal sample.
    double normality() const;
    /// 95 of 100 normal samples of this size have at least this normality(); a smaller one is evidence of another distribution.
    double normality_floor() const;
};

}  // namespace corpuscle
