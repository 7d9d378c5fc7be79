#include "sweep/stats/estimate.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sweep/spec/probability.hpp"

namespace corpuscle {
namespace {

constexpr double tail = (1 - confidence) / 2;  // probability beyond each end of an interval
constexpr std::size_t max_plotted = 1000;      // points of the normal probability plot

/// {n, d}: 1 - normality() is at most d in 95 of 100 normal samples of size n. Computed from 8000 random samples for each n (numpy; 600 for
/// the largest n). Looney and Gulledge (1985) publish 1 - d = 0.918, 0.951, 0.977 and 0.987 for n = 10, 20, 50 and 100.
constexpr std::pair<double, double> normality_deviation[] = {{5, 0.120},       {10, 0.0827},     {20, 0.0491},     {50, 0.0235},
                                                             {100, 0.0128},    {200, 0.00682},   {500, 0.00299},   {1000, 0.00153},
                                                             {2000, 0.000817}, {5000, 0.000322}, {20000, 8.07e-5}, {100000, 1.46e-5}};

/// The mean without this proportion of the smallest values and the same number of the largest.
double trimmed_mean(const std::vector<double>& sorted, double proportion) {
    const auto cut = std::min(static_cast<std::size_t>(proportion * static_cast<double>(sorted.size())), (sorted.size() - 1) / 2);
    double sum = 0;
    for (std::size_t k = cut; k < sorted.size() - cut; ++k) sum += sorted[k];
    return sum / static_cast<double>(sorted.size() - 2 * cut);
}

}  // namespace

Estimate estimate_proportion(std::int64_t count, std::int64_t total) {
    if (total <= 0) return {};
    const auto k = static_cast<double>(count), n = static_cast<double>(total);
    return {k / n, count == 0 ? 0 : beta_quantile(k, n - k + 1, tail), count == total ? 1 : beta_quantile(k + 1, n - k, 1 - tail)};
}

SortedSample::SortedSample(std::vector<double> values) : values_(std::move(values)) {
    std::erase_if(values_, [](double x) { return std::isnan(x); });
    std::sort(values_.begin(), values_.end());
    compute_moments();
}

SortedSample SortedSample::merged(const std::vector<SortedSample>& all) {
    SortedSample out;
    std::vector<std::ptrdiff_t> ends = {0};  // sample k is out.values_[ends[k]] ... before ends[k + 1]
    for (const auto& sample : all) {
        out.values_.insert(out.values_.end(), sample.values_.begin(), sample.values_.end());
        ends.push_back(static_cast<std::ptrdiff_t>(out.values_.size()));
    }
    std::vector<double> merged(out.values_.size());
    for (std::size_t width = 1; width < all.size(); width *= 2) {  // merges pairs of neighbouring samples, then pairs of the results
        const auto at = [&](std::size_t k) { return out.values_.begin() + ends[std::min(k, all.size())]; };
        for (std::size_t k = 0; k < all.size(); k += 2 * width)
            std::merge(at(k), at(k + width), at(k + width), at(k + 2 * width), merged.begin() + ends[k]);
        out.values_.swap(merged);
    }
    out.compute_moments();
    return out;
}

void SortedSample::compute_moments() {
    const auto n = static_cast<double>(values_.size());
    if (values_.empty()) return;
    double sum = 0;
    for (const double x : values_) sum += x;
    mean_ = sum / n;
    const double centre = n > 4 ? trimmed_mean(values_, 0.5 / std::sqrt(n - 4)) : mean_;
    for (const double x : values_) {
        const double deviation = x - mean_, from_centre = x - centre;
        squares_ += deviation * deviation, fourths_ += from_centre * from_centre * from_centre * from_centre;
    }
}

Estimate SortedSample::mean() const {
    const auto n = static_cast<double>(count());
    if (n < 2) return {mean_};
    const double half = student_quantile(n - 1, 1 - tail) * std::sqrt(squares_ / (n - 1) / n);
    return {mean_, mean_ - half, mean_ + half};
}

Estimate SortedSample::sigma() const {
    const auto n = static_cast<double>(count());
    if (n < 2) return {};
    const double variance = squares_ / (n - 1);
    if (n < 5 || variance == 0) return {std::sqrt(variance)};
    const double z = normal_quantile(1 - tail), c = n / (n - z), kurtosis = n * fourths_ / (squares_ * squares_);
    const double error = c * std::sqrt(std::max((kurtosis - (n - 3) / n) / (n - 1), 0.0));
    return {std::sqrt(variance), std::sqrt(c * variance * std::exp(-z * error)), std::sqrt(c * variance * std::exp(z * error))};
}

Estimate SortedSample::quantile(double q) const {
    if (values_.empty()) return {};
    const auto n = static_cast<double>(count());
    const double at = q * (n - 1), below = std::floor(at);
    const auto rank = [&](double k) { return values_[static_cast<std::size_t>(std::clamp(k, 0.0, n - 1))]; };
    Estimate out{rank(below) + (at - below) * (rank(below + 1) - rank(below))};
    // The true quantile is below the k-th smallest value if at most k - 1 of the n values are below it, and above that value if at least k
    // are. Both numbers have a binomial distribution. Each end of the interval is the innermost value for which this probability is at most
    // `tail`.
    const auto largest = [&](auto&& holds) {  // largest k of 0 ... n with holds(k), or -1; holds() must be true for all smaller k
        double k = -1;
        for (double step = std::exp2(std::ceil(std::log2(n + 1))); step >= 1; step /= 2)
            if (k + step <= n && holds(k + step)) k += step;
        return k;
    };
    const double low = largest([&](double k) { return binomial_up_to(k, n, q) <= tail; });  // at most `low` values are below
    const double high =
        n - largest([&](double k) { return 1 - binomial_up_to(n - k - 1, n, q) <= tail; });  // at least `high` values are below
    if (low >= 0 && low < n) out.low = rank(low);
    if (high - 1 >= 0 && high - 1 < n) out.high = rank(high - 1);
    return out;
}

double SortedSample::normality() const {
    const auto n = count(), plotted = std::min(n, max_plotted);
    if (n < 3 || squares_ == 0) return Estimate::none;
    double sum = 0, squares = 0, products = 0, scores = 0;  // over the plotted points; scores: sum of the squares of z
    for (std::size_t k = 0; k < plotted; ++k) {
        const auto i = static_cast<std::size_t>((static_cast<double>(k) + 0.5) * static_cast<double>(n) / static_cast<double>(plotted));
        const double z = normal_quantile((static_cast<double>(i) + 1 - 0.375) / (static_cast<double>(n) + 0.25)), x = values_[i] - mean_;
        sum += x, squares += x * x, products += x * z, scores += z * z;
    }
    const double variance_sum = squares - sum * sum / static_cast<double>(plotted);  // the scores sum to 0
    return variance_sum > 0 ? products / std::sqrt(variance_sum * scores) : Estimate::none;
}

double SortedSample::normality_floor() const {
    const auto n = static_cast<double>(count());
    if (n < 5) return Estimate::none;
    const auto* above = std::upper_bound(std::begin(normality_deviation), std::end(normality_deviation), n,
                                         [](double x, const auto& row) { return x < row.first; });
    if (above == std::end(normality_deviation)) return 1 - above[-1].second * above[-1].first / n;
    const auto& [n0, r0] = above[-1];
    return 1 - r0 * std::pow(above->second / r0, std::log(n / n0) / std::log(above->first / n0));
}

}  // namespace corpuscle
