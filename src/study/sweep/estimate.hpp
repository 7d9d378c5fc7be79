#pragma once
// What a sample says of the distribution it is from, each number with the interval in which the truth lies with 95 % confidence.

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace corpuscle {

inline constexpr double confidence = 0.95;

/// A number and its interval; NaN: the sample does not say.
struct Estimate {
    static constexpr double none = std::numeric_limits<double>::quiet_NaN();
    double value = none, low = none, high = none;
};

/// So many of so many, as a share; the interval of Clopper and Pearson: it never holds the truth less often than it says, also where all or
/// none have passed (Wilson's is narrower, and does).
Estimate share_of(std::int64_t some, std::int64_t all);

/// A sample in rising order.
class Sorted {
    std::vector<double> values_;
    double mean_ = Estimate::none, squares_ = 0, fourths_ = 0;  // sums of the distances' powers; fourths about the trimmed mean
    void sum_up();

    Sorted() = default;

public:
    /// NaNs are left out.
    explicit Sorted(std::vector<double> values);
    /// All of several together.
    static Sorted merged(const std::vector<Sorted>&);
    std::size_t count() const { return values_.size(); }
    const std::vector<double>& values() const { return values_; }

    /// Student's interval.
    Estimate mean() const;
    /// Of a sample, n - 1. The interval of Bonett (2006) goes by the sample's own kurtosis: chi-squared's, which is the normal
    /// distribution's alone, is far too narrow for what has long tails, as a chip's spike count has; and a bootstrap is 1000 times the
    /// work.
    Estimate sigma() const;
    /// Between order statistics, as R's and numpy's by default; its interval is from one order statistic to another, by the binomial
    /// distribution alone, whatever the sample is from; none where the sample is too small to have one.
    Estimate quantile(double q) const;
    /// Correlation of a normal plot, which is 1 for a normal distribution (Filliben 1975; positions after Blom), of at most 1000 points.
    double normality() const;
    /// What it is at least in 95 of 100 normal samples of this size; less is a sign of another distribution.
    double normality_floor() const;
};

}  // namespace corpuscle
