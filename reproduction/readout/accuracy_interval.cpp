#include "reproduction/readout/accuracy_interval.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace corpuscle {
namespace {

/// The variance of the mean that the spread between the groups gives. There must be at least two groups.
double variance_between_groups(const std::vector<double>& correct, const std::vector<std::size_t>& group, double mean) {
    std::map<std::size_t, double> sums;  // of the deviations from the mean, by group
    for (std::size_t k = 0; k < correct.size(); ++k) sums[group[k]] += correct[k] - mean;
    double squares = 0;
    for (const auto& [_, sum] : sums) squares += sum * sum;
    const auto groups = static_cast<double>(sums.size()), n = static_cast<double>(correct.size());
    return groups / (groups - 1) * squares / (n * n);
}

/// The number of independent trials that would be as sure.
double effective_trials(const std::vector<double>& correct, const std::vector<std::size_t>& group, double mean) {
    const double n = static_cast<double>(correct.size()), independent = mean * (1 - mean) / n;
    if (independent <= 0) {
        auto groups = group;
        std::sort(groups.begin(), groups.end());
        return static_cast<double>(std::unique(groups.begin(), groups.end()) - groups.begin());
    }
    return n / std::max(1.0, variance_between_groups(correct, group, mean) / independent);
}

}  // namespace

Accuracy accuracy_interval(const std::vector<double>& correct, const std::vector<std::size_t>& group) {
    constexpr double z = 1.959964;  // the 97.5 % quantile of the normal distribution
    const double p = std::accumulate(correct.begin(), correct.end(), 0.0) / static_cast<double>(correct.size());
    const double n = effective_trials(correct, group, p), shrink = 1 + z * z / n;
    const double middle = (p + z * z / (2 * n)) / shrink, half = z * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n)) / shrink;
    return {p, std::max(0.0, middle - half), std::min(1.0, middle + half)};
}

std::string interval_text(const Accuracy& a) { return fmt::format("95 % interval {:.0f} to {:.0f} %", 100 * a.low, 100 * a.high); }

}  // namespace corpuscle
