#pragma once
// Repairs a channel: removes isolated outliers, and fills missing samples (NaN) by linear interpolation. The result for a sample depends
// only on that sample and its neighbours, not on the size of the blocks that are read.
//
// push() adds samples and appends finished ones to `out`, after a delay. finish() appends the last ones at the end of the file.

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/error.hpp"

namespace corpuscle {

/// The argument of --despike: the largest distance of a sample from the median of the samples around it that is not an outlier.
struct DespikeOptions {
    /// In the unit of the values in the file. Default: 6 standard deviations, estimated from the median absolute deviation of these
    /// samples.
    std::optional<double> limit = {};
};

/// A Hampel filter: a sample whose distance from the median of the 25 samples around it (itself included) exceeds the limit becomes missing
/// (NaN). The output is delayed by 12 samples.
class HampelFilter {
    static constexpr std::size_t half_window = 12, window = 2 * half_window + 1;
    std::optional<double> limit_;
    std::vector<double> last_;    // the latest samples, at most `window`, oldest first
    std::vector<double> sorted_;  // those of them that are not missing, in ascending order
    std::size_t center_ = 0;      // index in last_ of the next sample to be filtered

    double filtered();

public:
    explicit HampelFilter(const DespikeOptions& despike) : limit_(despike.limit) {}
    void push(double x, std::vector<double>& out);
    void finish(std::vector<double>& out);
    std::int64_t outliers = 0;  ///< number of samples removed so far
};

/// Replaces missing samples (NaN) by linear interpolation. Missing samples at the beginning or the end of the recording are replaced by the
/// first or the last sample that is not missing. More than max_gap consecutive missing samples are an error.
class GapFiller {
    static constexpr std::int64_t max_gap = 1'000'000;             // samples
    double last_good_ = std::numeric_limits<double>::quiet_NaN();  // the latest sample that is not missing; NaN: none so far
    std::int64_t missing_ = 0;                                     // number of missing samples after it

    Result<void> push(double x, std::vector<double>& out);

public:
    Result<void> push(std::span<const double> x, std::vector<double>& out);
    Result<void> finish(std::vector<double>& out);
    std::int64_t filled = 0;  ///< number of samples replaced so far
};

}  // namespace corpuscle
