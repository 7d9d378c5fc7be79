#pragma once
// The processing of one channel from the values in the file to newtons. The steps are, in this order: removal of outliers, filling of gaps,
// offset and gain, filters. Fault detectors examine the samples between the steps.

#include "io/quality/fault_detectors.hpp"
#include "io/recording/recording.hpp"

namespace corpuscle {

/// Statistics of a channel's force, and how many samples are outside the range to which the models are fitted (0.2 to 4 N, thesis 1.2).
struct ForceLevels {
    double min = 1e308, max = -1e308;               ///< N, of all samples; these initial values: no samples yet
    std::int64_t below_range = 0, above_range = 0;  ///< numbers of samples below 0.2 N, and above 4 N
    std::int64_t negative = 0, count = 0;           ///< numbers of samples below 0 N, and of all samples
    void add(std::span<const double> force);
    /// n as a fraction of all samples.
    double fraction(std::int64_t n) const { return count > 0 ? static_cast<double>(n) / static_cast<double>(count) : 0; }
};

/// The pipeline of one channel. Rows are the samples as they are in the file, before resampling. The caller resamples the output of push()
/// and finish(), if requested, and then calls finish_force().
class ChannelPipeline {
    std::optional<HampelFilter> outlier_filter_;  // nullopt: --despike was not given
    GapFiller gaps_;
    double offset_, gain_;  // force in newtons = gain_ * (value in the file - offset_)
    std::vector<Biquad> filters_;
    bool filters_rows_;                        // true: filters the rows, which are evenly spaced; false: filters after resampling
    std::vector<double> despiked_, repaired_;  // scratch memory

    /// Removes outliers and fills gaps; appends the result to repaired_.
    Result<void> repair(std::span<const double> values);

public:
    /// `gain` is in newtons per unit of the values in the file. The filters run on the rows if `filters_rows`, otherwise on the resampled
    /// samples; `filter_clock` is the clock of the samples on which they run.
    static Result<ChannelPipeline> make(const RecordingOptions&, double gain, const Clock& filter_clock, bool filters_rows,
                                        const HumTable&);

    OutlierDetector outliers;       ///< of the samples before the filters
    SaturationDetector saturation;  ///< of the samples before the filters
    HumDetector hum;                ///< of the final force
    ForceLevels levels;             ///< of the final force

    double gain() const { return gain_; }
    double offset() const { return offset_; }
    /// The number of samples that --despike removed.
    std::int64_t outliers_removed() const { return outlier_filter_ ? outlier_filter_->outliers : 0; }
    /// The number of missing samples that were interpolated, including removed outliers.
    std::int64_t filled() const { return gaps_.filled; }

    /// Processes values of the file and appends newtons to `out`. Samples whose value depends on later ones (for a median, or in a gap) are
    /// appended by a later call.
    Result<void> push(std::span<const double> values, std::vector<double>& out);
    /// Appends the samples that are still waiting for later ones, at the end of the file.
    Result<void> finish(std::vector<double>& out);
    /// Filters the resampled samples if the filters do not run on the rows, and passes the final force to `hum` and `levels`.
    void finish_force(std::span<double> force);

private:
    ChannelPipeline(const RecordingOptions&, double gain, bool filters_rows, const HumTable&);
    void append(std::vector<double>& out);
};

}  // namespace corpuscle
