#pragma once
// The rows of a recording, with their forces in newtons. Reads blocks, passes each channel through its pipeline, and keeps the channels
// aligned although the pipelines can hold back different numbers of samples.

#include <optional>
#include <string>
#include <vector>

#include "io/recording/channel_pipeline.hpp"
#include "io/recording/row_reader.hpp"

namespace corpuscle {

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
