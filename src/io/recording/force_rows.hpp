#pragma once
// The rows of a recording: as they are in its table (RowReader), and with their forces in newtons (ForceRows), which the pipeline of each
// channel computes.

#include "io/quality/fault_detectors.hpp"
#include "io/quality/noise_detector.hpp"
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

/// The filters of --notch, --lowpass, --zero and --deadband for samples of this clock, in the order in which they apply.
Result<ChannelFilters> make_channel_filters(const RecordingOptions&, const Clock&);

/// The processing of one channel from the values in the file to newtons. The steps are, in this order: removal of outliers, filling of
/// gaps, offset and gain, filters. Fault detectors examine the samples between the steps. Rows are the samples as they are in the file,
/// before resampling. The caller resamples the output of push() and finish(), if requested, and then calls finish_force().
class ChannelPipeline {
    std::optional<HampelFilter> outlier_filter_;  // nullopt: --despike was not given
    GapFiller gaps_;
    double offset_, gain_;  // force in newtons = gain_ * (value in the file - offset_)
    ChannelFilters filters_;
    bool filters_rows_;                        // true: filters the rows, which are evenly spaced; false: filters after resampling
    std::vector<double> despiked_, repaired_;  // scratch memory

    /// Removes outliers and fills gaps; appends the result to repaired_.
    Result<void> repair(std::span<const double> values);

public:
    /// The filters run on the rows if `filters_rows`, otherwise on the resampled
    /// samples; `filter_clock` is the clock of the samples on which they run.
    static Result<ChannelPipeline> make(const RecordingOptions&, const ChannelScale&, const Clock& filter_clock, bool filters_rows,
                                        const HumTable&);

    bool is_component = false;      ///< true: an axis or an angle of a three-axis sensor; it may be negative or constant
    OutlierDetector outliers;       ///< of the samples before the filters
    SaturationDetector saturation;  ///< of the samples before the filters
    NoiseDetector noise;            ///< of the samples after the filters, before the deadband
    HumDetector hum;                ///< of the final force
    ForceLevels levels;             ///< of the final force

    double gain() const { return gain_; }
    double offset() const { return offset_; }
    const ChannelFilters& filters() const { return filters_; }
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
    ChannelPipeline(const RecordingOptions&, const ChannelScale&, bool filters_rows, const HumTable&);
    void append(std::vector<double>& out);
    void filter(std::span<double> force);
};

/// Reads the rows of a table as the options require: takes absolute values, and treats values that are not numbers or are outside --range.
/// Such a value is an error, or its row is dropped, or it becomes a gap (NaN).
class RowReader {
    Table& table_;
    const RecordingOptions& options_;
    std::vector<std::size_t> columns_;     // the channels, followed by the time column if there is one
    std::size_t channels_;                 // number of channels
    std::vector<std::size_t> table_rows_;  // if rows are dropped: for each row of the last block, its index in the block before dropping

    bool drops_rows() const { return options_.bad_fields == BadFields::drop; }
    Result<void> apply_range(std::size_t rows, std::vector<std::vector<double>>& block);
    std::size_t drop_incomplete(std::size_t rows, std::vector<std::vector<double>>& block);

public:
    /// `channels` and `time` are indices of columns of the table. In each block the time column, if there is one, follows the channels.
    RowReader(Table&, const RecordingOptions&, std::vector<std::size_t> channels, std::optional<std::size_t> time);

    /// Reads the next rows, at most `rows_per_block`, into one vector for each column, and resizes the vectors to the number of rows.
    /// Returns this number; 0 at the end of the table.
    Result<std::size_t> next(std::vector<std::vector<double>>& block);

    /// The location in the file of row `row` of the last block.
    SourceLocation location(std::size_t row) const { return table_.location(table_row(row)); }
    /// The index that row `row` of the last block had before rows were dropped.
    std::size_t table_row(std::size_t row) const { return drops_rows() ? table_rows_[row] : row; }

    std::int64_t out_of_range = 0, dropped = 0;  ///< numbers so far: of values outside --range, and of dropped rows
};

/// Reads blocks, passes each channel through its pipeline, and keeps the channels aligned although the pipelines can hold back different
/// numbers of samples.
class ForceRows {
    RowReader rows_;
    std::vector<ChannelPipeline> pipelines_;  // for each channel
    std::string path_;                        // of the file, for messages
    std::vector<std::string> names_;          // of the channels, for messages
    std::optional<GapFiller> times_;          // fills gaps in the times; set if each row has its own time
    SumDetector sums_;
    std::vector<std::vector<double>> block_;  // for each column, the values as read
    std::vector<std::vector<double>> ready_;  // for each channel, samples in newtons; then the times, if each row has its own time
    std::size_t consumed_ = 0;                // rows at the beginning of ready_ that the caller has used
    bool ended_ = false;                      // true after the end of the file

    /// Adds the name of channel c to an error; c is the number of channels for the time.
    Error channel_error(std::size_t c, Error) const;
    Result<void> read_block();

public:
    /// The first columns of `rows` are the channels, in the order of `pipelines` and `names`. If `timed`, the column after them is the time
    /// of each row; otherwise a column after them is ignored.
    ForceRows(RowReader rows, std::vector<ChannelPipeline> pipelines, std::string path, std::vector<std::string> names, bool timed);

    /// Reads blocks until at least one row is ready, that is, has a force in every channel. Returns false at the end of the file.
    Result<bool> fetch_row();
    /// The number of ready rows that the caller has not used.
    std::size_t ready_rows() const;
    /// The force in newtons and the time of the first ready row. The time is in the unit of the file, and exists only if `timed`.
    double force(std::size_t channel) const { return ready_[channel][consumed_]; }
    double time() const { return ready_.back()[consumed_]; }
    /// Marks the first `rows` ready rows as used.
    void advance(std::size_t rows = 1) { consumed_ += rows; }
    /// The forces of one channel in all ready rows, in newtons.
    const double* ready_data(std::size_t channel) const { return ready_[channel].data() + consumed_; }

    std::vector<ChannelPipeline>& pipelines() { return pipelines_; }
    const std::vector<ChannelPipeline>& pipelines() const { return pipelines_; }
    const RowReader& rows() const { return rows_; }
    const SumDetector& sums() const { return sums_; }
};

}  // namespace corpuscle
