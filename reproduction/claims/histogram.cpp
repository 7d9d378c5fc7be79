#include "reproduction/claims/histogram.hpp"

#include <algorithm>

namespace corpuscle {

StudyCurve histogram_of(const std::vector<double>& values, int bins) {
    StudyCurve out;
    if (values.empty()) return out;
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    const double width = (*high - *low) / bins;
    std::vector<double> counts(static_cast<std::size_t>(bins));
    // The largest value belongs to the last bin. If all values are equal, they are in the first.
    for (const double v : values) ++counts[static_cast<std::size_t>(std::min(width > 0 ? (v - *low) / width : 0, bins - 1.0))];
    for (std::size_t k = 0; k < counts.size(); ++k)
        out.x.push_back(*low + (static_cast<double>(k) + 0.5) * width), out.y.push_back(counts[k]);
    return out;
}

}  // namespace corpuscle
