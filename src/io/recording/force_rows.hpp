#pragma once
// The rows of a recording: as they are in its table (RowReader), and with their forces in newtons (ForceRows).

#include "io/recording/channel_pipeline.hpp"

namespace corpuscle {

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
