#pragma once
// Repairs a channel: removes isolated outliers, and fills missing and out-of-range samples by linear interpolation. The result for a
// sample depends only on the sample and its neighbours, not on the block size.

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "signal/error.hpp"

namespace corpuscle {

/// The argument of --despike: the largest distance of a sample from the median of its neighbours.
struct DespikeOptions {
    /// In the file's unit. Default: 6 standard deviations, estimated from the median absolute deviation of the window.
    std::optional<double> limit = {};
};

/// A Hampel filter: a sample further than the limit from the median of the 25 samples around it becomes missing (NaN). The output is
/// delayed by 12 samples.
class HampelFilter {
    static constexpr std::size_t half_window = 12, window = 2 * half_window + 1;
    std::optional<double> limit_;
    std::vector<double> last_;    // at most `window` samples, oldest first
    std::vector<double> sorted_;  // the finite ones among them
    std::size_t center_ = 0;      // index in last_ of the next sample to be filtered

    double filtered();

public:
    explicit HampelFilter(const DespikeOptions& despike) : limit_(despike.limit) {}
    void push(double x, std::vector<double>& out);
    void finish(std::vector<double>& out);
    std::int64_t outliers = 0;
};

/// Replaces missing samples (NaN) by linear interpolation. At either end of the recording the nearest sample is
/// repeated.
class GapFiller {
    static constexpr std::int64_t max_gap = 1'000'000;  // samples
    double last_good_ = std::numeric_limits<double>::quiet_NaN();
    std::int64_t missing_ = 0;  // number of missing samples since `last_good_`

    Result<void> push(double x, std::vector<double>& out);

public:
    Result<void> push(std::span<const double> x, std::vector<double>& out);
    Result<void> finish(std::vector<double>& out);
    std::int64_t filled = 0;
};

}  // namespace corpuscle
