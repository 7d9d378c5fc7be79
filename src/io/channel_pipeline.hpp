#pragma once
// The processing of one channel from file values to newtons: outlier removal, gap filling, offset and gain, filters. Fault detectors
// examine the channel on the way.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/biquad.hpp"
#include "io/fault_detectors.hpp"
#include "io/recording.hpp"
#include "io/repair.hpp"

namespace corpuscle {

/// Statistics of a channel's force relative to the range that the models are fitted to (thesis 1.2: 0.2 to 4 N).
struct ForceLevels {
    double min = 1e308, max = -1e308;
    std::int64_t below_range = 0, above_range = 0, negative = 0, count = 0;
    void add(std::span<const double>);
    double fraction(std::int64_t n) const { return count > 0 ? static_cast<double>(n) / static_cast<double>(count) : 0; }
};

class ChannelPipeline {
    std::optional<HampelFilter> outlier_filter_;
    GapFiller gaps_;
    double offset_, gain_;
    std::vector<Biquad> filters_;
    bool filters_rows_;                        // true: filter the rows, which are evenly spaced; false: filter after resampling
    std::vector<double> despiked_, repaired_;  // scratch memory

    Result<void> repair(std::span<const double> values);

public:
    /// `gain` is in newtons per unit of the file. `filter_clock` is the clock of the samples that are filtered: before resampling if
    /// `filter_early`, otherwise after it.
    static Result<ChannelPipeline> make(const RecordingOptions&, double gain, const Clock& filter_clock, bool filter_early,
                                        const HumTable&);

    OutlierDetector outliers;
    SaturationDetector saturation;
    HumDetector hum;
    ForceLevels levels;

    double gain() const { return gain_; }
    double offset() const { return offset_; }
    std::int64_t outliers_removed() const { return outlier_filter_ ? outlier_filter_->outliers : 0; }
    std::int64_t filled() const { return gaps_.filled; }

    /// Processes values of the file and appends newtons to `out`. Values that depend on later ones are appended by a later call.
    Result<void> push(std::span<const double> values, std::vector<double>& out);
    /// Appends the remaining samples.
    Result<void> finish(std::vector<double>& out);
    /// Applies the filters that run after resampling, and updates the statistics of the final force.
    void finish_force(std::span<double> force);

private:
    ChannelPipeline(const RecordingOptions&, double gain, bool filter_early, const HumTable&);
    void append(std::vector<double>& out);
};

}  // namespace corpuscle
