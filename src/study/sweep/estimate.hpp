#pragma once
// Estimates of the distribution behind a sample, each with its 95 % confidence interval.

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace corpuscle {

inline constexpr double confidence = 0.95;

/// A number and its confidence interval; NaN if the sample is too small.
struct Estimate {
    static constexpr double none = std::numeric_limits<double>::quiet_NaN();
    double value = none, low = none, high = none;
};

/// The proportion count / total with the interval of Clopper and Pearson. Its coverage is never below the confidence level, even if the
/// count is 0 or `total`. (Wilson's interval is narrower, but its coverage can be lower.)
Estimate estimate_proportion(std::int64_t count, std::int64_t total);

/// A sample in ascending order.
class SortedSample {
    std::vector<double> values_;
    // sums of powers of the distances from the mean; fourths_: from the trimmed mean
    double mean_ = Estimate::none, squares_ = 0, fourths_ = 0;
    void compute_moments();

    SortedSample() = default;

public:
    /// NaNs are left out.
    explicit SortedSample(std::vector<double> values);
    /// All samples together.
    static SortedSample merged(const std::vector<SortedSample>&);
    std::size_t count() const { return values_.size(); }
    const std::vector<double>& values() const { return values_; }

    /// With Student's interval.
    Estimate mean() const;
    /// Standard deviation over n - 1, with the interval of Bonett (2006), which uses the sample's kurtosis. The chi-squared interval
    /// assumes a normal distribution and is far too narrow for long tails, such as those of a chip's spike count. A bootstrap costs 1000
    /// times as much.
    Estimate sigma() const;
    /// Interpolated between order statistics, as by default in R and numpy. The interval is from one order statistic to another by the
    /// binomial distribution, valid for any distribution; NaN if the sample is too small.
    Estimate quantile(double q) const;
    /// Correlation of a normal probability plot, 1 for a normal distribution (Filliben 1975; plotting positions after Blom), of at most
    /// 1000 points.
    double normality() const;
    /// 95 of 100 normal samples of this size have at least this normality(); a smaller one is evidence of another distribution.
    double normality_floor() const;
};

}  // namespace corpuscle
