#pragma once
// The rows of a recording in newtons. Reads blocks, passes each channel through its pipeline, and keeps the channels aligned although
// the pipelines have different delays.

#include <optional>
#include <string>
#include <vector>

#include "io/channel_pipeline.hpp"
#include "io/row_reader.hpp"

namespace corpuscle {

class ForceRows {
    RowReader rows_;
    std::vector<ChannelPipeline> pipelines_;
    std::string path_;                // of the file, for errors
    std::vector<std::string> names_;  // of the channels, for errors
    std::optional<GapFiller> times_;  // fills gaps in the times; set if each row has its own time
    SumDetector sums_;
    std::vector<std::vector<double>> block_;  // as read
    std::vector<std::vector<double>> ready_;  // for each channel, in newtons; then the times
    std::size_t consumed_ = 0;                // rows of ready_ that have been consumed
    bool ended_ = false;

    Error channel_error(std::size_t c, Error) const;
    Result<void> read_block();

public:
    /// `rows` provides the channels in the order of `pipelines`. If `timed`, the next column is the time; otherwise it is ignored.
    ForceRows(RowReader rows, std::vector<ChannelPipeline> pipelines, std::string path, std::vector<std::string> names, bool timed);

    /// Reads blocks until a row is ready. Returns false at the end of the file.
    Result<bool> fetch_row();
    std::size_t ready_rows() const;
    double force(std::size_t channel) const { return ready_[channel][consumed_]; }
    double time() const { return ready_.back()[consumed_]; }  ///< in the unit of the file; only if `timed`
    void advance(std::size_t rows = 1) { consumed_ += rows; }
    const double* ready_data(std::size_t channel) const { return ready_[channel].data() + consumed_; }

    std::vector<ChannelPipeline>& paths() { return pipelines_; }
    const std::vector<ChannelPipeline>& paths() const { return pipelines_; }
    const RowReader& rows() const { return rows_; }
    const SumDetector& sums() const { return sums_; }
};

}  // namespace corpuscle
