#include "io/quality/deadband.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace corpuscle {

double noise_deviation(std::vector<double>& samples, double level) {
    // The mean of |z| over the nine tenths of a standard normal distribution with the smallest |z|: 2 (p(0) - p(q)) / 0.9, where p is the
    // density and q = 1.6449 the limit of |z|.
    constexpr double mean_of_normal = 0.65733;
    if (samples.empty()) return 0;
    for (double& x : samples) x = std::abs(x - level);
    std::sort(samples.begin(), samples.end());
    const std::size_t kept = samples.size() - samples.size() / 10;
    const double sum = std::accumulate(samples.begin(), samples.begin() + static_cast<std::ptrdiff_t>(kept), 0.0);
    return sum / static_cast<double>(kept) / mean_of_normal;
}

}  // namespace corpuscle
